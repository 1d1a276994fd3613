//! Gives the shared library its soname, so that a program finds the library of its own binary
//! interface when another one is installed beside it.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        // The number of `TEXERE_ABI`; a test holds the two equal.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libtexere_c.so.1");
    }
}
