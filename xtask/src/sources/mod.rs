//! `cargo xtask sources`: rules of the sources that the compiler and clippy don't check.

mod circles;
mod comments;
mod files;
mod functions;

use crate::steps::Steps;
use crate::workspace;

/// Prints each breach of the three rules, and fails if there is one.
pub(crate) fn run(steps: &mut Steps) {
    let packages = match workspace::packages() {
        Ok(packages) => packages,
        Err(error) => return steps.fail(error),
    };
    let (files, circles) = match files::all().and_then(|files| Ok((files, circles::find(&packages)?))) {
        Ok(found) => found,
        Err(error) => return steps.fail(error),
    };
    report(steps, "circles of files that import one another", &circles);
    report(steps, "functions of more than 80 lines", &functions::find(&files));
    report(steps, "comments wider than 100 columns", &comments::find(&files));
}

fn report(steps: &mut Steps, what: &str, offences: &[String]) {
    println!("\n==> {what}: {}", offences.len());
    for offence in offences {
        println!("{offence}");
    }
    if !offences.is_empty() {
        steps.fail(format!("{what}: {}", offences.len()));
    }
}
