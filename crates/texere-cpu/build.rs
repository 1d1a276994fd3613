//! Sets the configuration `optimized` if the compiler optimises. The vector code is inlined only
//! then.
//!
//! Code that is generic over vectors is fast only where it is inlined into a function that is
//! compiled for the vectors' instructions. In a build without optimisation, inlining would gather
//! the temporaries of hundreds of functions in one frame of megabytes, which is more than a
//! thread's stack may hold.

fn main() {
    println!("cargo::rustc-check-cfg=cfg(optimized)");
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var_os("OPT_LEVEL").is_some_and(|level| level != "0") {
        println!("cargo::rustc-cfg=optimized");
    }
}
