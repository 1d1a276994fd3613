//! Options that decide whether yarns settle.

use std::path::PathBuf;

use texere::Design;

use super::path::file_of;

#[derive(Debug, clap::Args)]
pub(crate) struct SettlingArgs {
    #[command(flatten)]
    rest: RestArgs,
    /// Draw how yarns came to rest, pass by pass, to an .svg file
    #[arg(long, value_name = "FILE", conflicts_with = "no_settle", value_parser = file_of(&["svg"]))]
    pub(crate) settling_plot: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct RestArgs {
    /// Let yarns come to rest first, whatever the design says. Yarns move until none pierces
    /// another or folds. Saved yarns and curves are held at their ends
    #[arg(long, conflicts_with = "no_settle")]
    settle: bool,
    /// Leave yarns as the structure places them, whatever the design says
    #[arg(long)]
    no_settle: bool,
}

impl SettlingArgs {
    /// Whether the yarns of `design` settle.
    pub(crate) fn settles(&self, design: &Design) -> bool {
        self.rest.settles().unwrap_or(design.settle)
    }
}

impl RestArgs {
    /// Whether yarns settle, or none if the command line does not say.
    pub(crate) const fn settles(&self) -> Option<bool> {
        match (self.settle, self.no_settle) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }
}
