use alloc::collections::VecDeque;

use clap::{Args, Command, ValueEnum};
use clap_complete::Shell;

use super::failure::Failure;
use super::stdout::write_all;

/// Print the completions of a shell, or the man page.
#[derive(Args, Debug)]
#[command(after_long_help = "Examples:
  lights completions bash > ~/.local/share/bash-completion/completions/lights
  lights completions zsh > ~/.zfunc/_lights
  lights completions fish > ~/.config/fish/completions/lights.fish
  lights completions man > ~/.local/share/man/man1/lights.1")]
pub(crate) struct CompletionsArgs {
    /// Whose completions; or the man page of the program and all of its commands.
    #[arg(value_name = "SHELL|man", value_enum)]
    what: What,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    Bash,
    Elvish,
    Fish,
    /// PowerShell.
    #[value(name = "powershell")]
    PowerShell,
    Zsh,
    Man,
}

impl CompletionsArgs {
    /// Prints what was asked for, of `program`.
    ///
    /// # Errors
    /// When standard output takes nothing.
    pub(crate) fn run(&self, mut program: Command) -> Result<(), Failure> {
        let shell = match self.what {
            What::Bash => Shell::Bash,
            What::Elvish => Shell::Elvish,
            What::Fish => Shell::Fish,
            What::PowerShell => Shell::PowerShell,
            What::Zsh => Shell::Zsh,
            What::Man => return man(program),
        };
        let mut script = Vec::new();
        clap_complete::generate(shell, &mut program, "lights", &mut script);
        write_all(&script)
    }
}

/// Prints one page: the program, then each command as a section of its own.
///
/// # Errors
/// When standard output takes nothing.
pub(super) fn man(mut program: Command) -> Result<(), Failure> {
    program.build();
    let mut page = Vec::new();
    let failed = |error: std::io::Error| Failure::Input(format!("the man page: {error}"));
    let whole = clap_mangen::Man::new(program.clone());
    whole.render(&mut page).map_err(failed)?;
    let mut commands: VecDeque<Command> = program.get_subcommands().cloned().collect();
    while let Some(command) = commands.pop_front() {
        if command.get_name() == "help" {
            continue;
        }
        if command.has_subcommands() {
            commands.extend(command.get_subcommands().cloned());
            continue;
        }
        let name = command.get_bin_name().unwrap_or_else(|| command.get_name());
        page.extend(format!(".SH \"{}\"\n", name.to_uppercase()).bytes());
        let section = clap_mangen::Man::new(command);
        let sections = [
            clap_mangen::Man::render_synopsis_section,
            clap_mangen::Man::render_description_section,
            clap_mangen::Man::render_options_section,
            clap_mangen::Man::render_extra_section,
        ];
        for render in sections {
            let mut part = Vec::new();
            render(&section, &mut part).map_err(failed)?;
            // Within the section of a command these are parts of it.
            page.extend(
                String::from_utf8_lossy(&part)
                    .replace(".SH ", ".SS ")
                    .bytes(),
            );
        }
    }
    write_all(&page)
}
