//! The two ways in which the `texere` program and the libraries of C and Python are built.

use crate::steps::Steps;

/// How the `texere` program and the libraries of C and Python are built.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Build {
    /// Optimised, as users have them.
    Released,
    /// Together with all packages of the workspace, as for the tests. Checks use this build, so
    /// that no package is compiled a second time.
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
        // One call builds the program and the library. In two calls, wgpu would have different
        // features, so that each call would compile wgpu again.
        let released = ["--package", "texere-capi", "--package", "texere-cli", "--no-default-features"];
        let released = [&["--release"][..], &released, &["--features", "texere-capi/default"]].concat();
        let chosen = match self {
            Self::Released => released,
            // Examples and tests need the dev-dependencies. Without the examples, cargo would
            // choose other features than for tests, and compile the packages again.
            Self::Tested => vec!["--workspace", "--lib", "--bin", "texere", "--examples"],
        };
        steps.cargo("the program and its libraries", &[&["build", "--locked"][..], &chosen].concat(), &[]);
    }
}
