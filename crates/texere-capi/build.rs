//! Gives the shared library its soname, so that a program finds the library of its own binary
//! interface when another one is installed beside it, and says whether there is Vulkan.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // Where wgpu has Vulkan.
    println!("cargo::rustc-check-cfg=cfg(vulkan)");
    let system = std::env::var("CARGO_CFG_TARGET_OS");
    if std::env::var_os("CARGO_FEATURE_WGPU").is_some()
        && matches!(system.as_deref(), Ok("linux" | "windows"))
    {
        println!("cargo::rustc-cfg=vulkan");
    }
    if system.as_deref() == Ok("linux") {
        // The number of `TEXERE_ABI`; a test holds the two equal.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libtexere_c.so.1");
    }
}
