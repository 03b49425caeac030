use core::ops::ControlFlow;
use std::path::Path;

use clap::Args;

use crate::Film;
use crate::live::{FileStamps, TevAddress, TevViewer};

use super::failure::Failure;
use super::interrupt::GentleStop;
use super::stdout::complain;

/// Pictures that are seen while they are made.
#[derive(Args, Debug)]
pub(crate) struct LiveArgs {
    /// Show the growing picture in the image viewer tev: `tev` for one on this machine, else
    /// tev=HOST[:PORT].
    #[arg(long, value_name = "tev[=HOST:PORT]", conflicts_with = "aov")]
    view: Option<TevAddress>,
    /// Render again when a file of the scene changes, until Ctrl-C.
    #[arg(long, conflicts_with_all = ["samples", "checkpoint", "aov", "skip_existing"])]
    pub(crate) watch: bool,
}

/// Who looks at a rendering, and may end it.
pub(super) struct Watcher<'a> {
    viewer: Option<TevViewer>,
    /// Files whose change ends the rendering.
    stamps: Option<&'a mut FileStamps>,
    stop: Option<&'a GentleStop>,
    changed: bool,
}

impl LiveArgs {
    /// Opens the viewer that was asked for, with an image named after the output.
    ///
    /// # Errors
    /// When no viewer listens there.
    pub(super) fn watcher<'a>(
        &self,
        output: &Path,
        size: (u32, u32),
        stamps: Option<&'a mut FileStamps>,
        stop: Option<&'a GentleStop>,
    ) -> Result<Watcher<'a>, Failure> {
        let open = |address: &TevAddress| {
            let viewer = TevViewer::open(address, &output.display().to_string(), size);
            viewer.map_err(|error| {
                let message = format!("--view: {address} cannot be reached: {error}");
                Failure::Input(message)
            })
        };
        Ok(Watcher {
            viewer: self.view.as_ref().map(open).transpose()?,
            stamps,
            stop,
            changed: false,
        })
    }
}

impl Watcher<'_> {
    /// Shows the picture so far, and says whether to go on.
    pub(super) fn look(&mut self, film: &Film) -> ControlFlow<()> {
        self.show(|viewer| viewer.show(film));
        self.changed = self
            .stamps
            .as_mut()
            .is_some_and(|stamps| stamps.changed().is_some());
        if self.changed || self.stop.is_some_and(GentleStop::is_asked) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Shows the finished picture.
    pub(super) fn finish(&mut self, film: &Film) {
        self.show(|viewer| viewer.show_last(film));
    }

    /// Whether a file changed, so that the picture is that of an old scene.
    pub(super) const fn has_changed(&self) -> bool {
        self.changed
    }

    /// A viewer that is closed is no reason to stop.
    fn show(&mut self, send: impl FnOnce(&mut TevViewer) -> std::io::Result<()>) {
        if let Some(viewer) = &mut self.viewer
            && let Err(error) = send(viewer)
        {
            complain(format_args!(
                "warning: the viewer takes no picture any more: {error}"
            ));
            self.viewer = None;
        }
    }
}
