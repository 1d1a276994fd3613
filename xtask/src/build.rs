//! The two ways in which the `texere` program and the libraries of C and Python are built.

use crate::steps::Steps;

/// How the `texere` program and the libraries of C and Python are built.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Build {
    /// Optimised, as users have them.
    Released,
    /// With all packages of the workspace, as tests have them. Checks use these, so that they are
    /// not compiled a second time.
    Tested,
}

impl Build {
    /// The folder of what is built, from the repository's root.
    pub(crate) const fn folder(self) -> &'static str {
        match self {
            Self::Released => "target/release",
            Self::Tested => "target/debug",
        }
    }

    /// Builds the `texere` program and the library of C. [`Build::Tested`] builds that of Python,
    /// too.
    pub(crate) fn libraries(self, steps: &mut Steps) {
        // One call builds both. If each were built by itself, wgpu would have other features, and
        // each build would compile it again after the other.
        let released = ["--package", "texere-capi", "--package", "texere-cli", "--no-default-features"];
        let released = [&["--release"][..], &released, &["--features", "texere-capi/default"]].concat();
        let chosen = match self {
            Self::Released => released,
            // Examples have the features of tests. Without examples, all would be compiled twice.
            Self::Tested => vec!["--workspace", "--lib", "--bin", "texere", "--examples"],
        };
        steps.cargo("the program and its libraries", &[&["build", "--locked"][..], &chosen].concat(), &[]);
    }
}
