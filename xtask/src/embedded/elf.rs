use std::collections::BTreeMap;

/// The sizes of a program, from the tables of its file (ELF, 32 bits, little-endian).
#[derive(Debug, Default)]
pub(super) struct Program {
    /// Bytes of code.
    pub(super) code: u32,
    /// Bytes of constants, the scene among them.
    pub(super) constants: u32,
    /// Bytes of static variables.
    pub(super) memory: u32,
    /// Functions and constants with a size.
    symbols: Vec<Symbol>,
    /// All names, also of functions without a size.
    names: Vec<String>,
}

#[derive(Debug)]
struct Symbol {
    krate: String,
    kind: Kind,
    size: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Constant,
    Function,
}

/// Flags and types of sections and symbols.
const WRITABLE: u32 = 1;
const LOADED: u32 = 2;
const EXECUTABLE: u32 = 4;
const SYMBOL_TABLE: u32 = 2;
const OBJECT: u8 = 1;
const FUNCTION: u8 = 2;

impl Program {
    /// The program in the bytes of its file.
    ///
    /// # Errors
    /// If it is not of the form that the linker writes.
    pub(super) fn new(file: &[u8]) -> Result<Self, String> {
        Self::read(file).ok_or_else(|| "not a program of 32 bits".to_owned())
    }

    fn read(file: &[u8]) -> Option<Self> {
        if file.get(..6)? != b"\x7fELF\x01\x01" {
            return None;
        }
        let sections = word(file, 0x20)? as usize;
        let [entry, count] = [half(file, 0x2e)?, half(file, 0x30)?].map(usize::from);
        let section = |index: usize, field: usize| word(file, sections + index * entry + 4 * field);
        let mut program = Self::default();
        for index in 0..count {
            let size = section(index, 5)?;
            match section(index, 2)? & (WRITABLE | LOADED | EXECUTABLE) {
                LOADED => program.constants += size,
                flags if flags & LOADED == 0 => {}
                flags if flags & WRITABLE != 0 => program.memory += size,
                _ => program.code += size,
            }
            if section(index, 1)? == SYMBOL_TABLE {
                let names = section(section(index, 6)? as usize, 4)? as usize;
                let start = section(index, 4)? as usize;
                program.read_symbols(file.get(start..)?.get(..size as usize)?, file, names)?;
            }
        }
        Some(program)
    }

    fn read_symbols(&mut self, table: &[u8], file: &[u8], names: usize) -> Option<()> {
        for symbol in table.chunks_exact(16) {
            let name = file.get(names + word(symbol, 0)? as usize..)?;
            let name = String::from_utf8_lossy(name.split(|&byte| byte == 0).next()?).into_owned();
            let kind = match symbol[12] & 15 {
                FUNCTION => Some(Kind::Function),
                OBJECT => Some(Kind::Constant),
                _ => None,
            };
            if let Some(kind) = kind {
                self.symbols.push(Symbol {
                    krate: crate_of(&name).unwrap_or("others").to_owned(),
                    kind,
                    size: word(symbol, 8)?,
                });
            }
            self.names.push(name);
        }
        Some(())
    }

    /// Bytes of code by crate, the largest first; what the compiler put inside of a function of
    /// another crate counts there.
    pub(super) fn code_by_crate(&self) -> Vec<(&str, u32)> {
        let mut sums = BTreeMap::new();
        let functions = self.symbols.iter().filter(|s| s.kind == Kind::Function);
        for symbol in functions {
            *sums.entry(symbol.krate.as_str()).or_insert(0) += symbol.size;
        }
        let mut sums: Vec<_> = sums.into_iter().filter(|&(_, size)| size > 0).collect();
        sums.sort_by_key(|&(_, size)| core::cmp::Reverse(size));
        sums
    }

    /// The routines of 64-bit floats that are linked.
    pub(super) fn doubles(&self) -> Vec<&str> {
        let names = self.names.iter().map(String::as_str);
        let mut doubles: Vec<_> = names.filter(|name| is_double(name)).collect();
        doubles.sort_unstable();
        doubles.dedup();
        doubles
    }

    /// Prints the sizes.
    pub(super) fn print(&self) {
        println!(
            "        {} bytes of code, {} of constants, {} of static variables",
            self.code, self.constants, self.memory
        );
        let crates = self.code_by_crate();
        let crates = crates.iter().map(|(name, size)| format!("{name} {size}"));
        println!("        code: {}", crates.collect::<Vec<_>>().join(", "));
        match &self.doubles()[..] {
            [] => println!("        no routine of 64-bit floats"),
            doubles => println!("        64-bit floats: {}", doubles.join(" ")),
        }
    }
}

/// The crate in a mangled name: the first one, as in `_RNvNtCs1234_10light_math5float4sqrt`.
///
/// Names of the form v0 say a crate as `Cs`, a hash, `_`, and its name after its length.
fn crate_of(name: &str) -> Option<&str> {
    let path = name.strip_prefix("_R")?;
    let starts = path.match_indices("Cs").map(|(at, _)| &path[at + 2..]);
    starts.into_iter().find_map(|rest| {
        let (hash, rest) = rest.split_once('_')?;
        let is_hash = hash.bytes().all(|byte| byte.is_ascii_alphanumeric());
        let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let length = rest[..digits].parse().ok()?;
        rest[digits..].get(..length).filter(|_| is_hash)
    })
}

/// Whether a routine of the compiler computes with 64-bit floats or converts them, by the names of
/// ARM's interface and of the compiler's own.
fn is_double(name: &str) -> bool {
    const ARM: [&str; 4] = ["f2d", "i2d", "ui2d", "l2d"];
    if let Some(arm) = name.strip_prefix("__aeabi_") {
        return arm.starts_with('d')
            || arm.starts_with("cd")
            || arm == "ul2d"
            || ARM.contains(&arm);
    }
    let own = name.strip_prefix("__").unwrap_or_default();
    own.contains("df") && own.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(
        bytes.get(at..)?.get(..4)?.try_into().ok()?,
    ))
}

fn half(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_le_bytes(
        bytes.get(at..)?.get(..2)?.try_into().ok()?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_their_crate() {
        let of = |name| crate_of(name);
        let plain = "_RNvNtNtCscDKtLBOjLOZ_9light_bvh5query6select6search";
        assert_eq!(of(plain), Some("light_bvh"), "a function");
        let inner =
            "_RINvMNtNtCscDKtLBOjLOZ_9light_bvh5query7Weights9from_afarECs2r8C_14light_embedded";
        assert_eq!(
            of(inner),
            Some("light_bvh"),
            "of a generic function its own"
        );
        assert_eq!(of("bare_main"), None, "without a crate");
    }

    #[test]
    fn doubles_are_known_by_name() {
        for name in [
            "__aeabi_dadd",
            "__aeabi_f2d",
            "__aeabi_cdcmple",
            "__adddf3",
            "__extendsfdf2",
        ] {
            assert!(is_double(name), "{name}");
        }
        for name in [
            "__aeabi_fadd",
            "__aeabi_ul2f",
            "__aeabi_memcpy4",
            "__addsf3",
            "bare_main",
        ] {
            assert!(!is_double(name), "{name}");
        }
    }

    #[test]
    fn what_is_no_program_is_refused() {
        assert!(Program::new(b"").is_err(), "empty");
        assert!(Program::new(b"\x7fELF\x02\x01 of 64 bits").is_err(), "wide");
        assert!(Program::new(b"\x7fELF\x01\x01").is_err(), "cut off");
    }
}
