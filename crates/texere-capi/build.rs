//! Gives the shared library its soname, so that a program finds the library of its own binary
//! interface when another one is installed beside it, and says whether there is Vulkan.

use std::error::Error;

/// The header, which is made of the sources and says the number of the binary interface.
const HEADER: &str = "include/texere.h";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={HEADER}");
    // Where wgpu has Vulkan.
    println!("cargo::rustc-check-cfg=cfg(vulkan)");
    let system = std::env::var("CARGO_CFG_TARGET_OS");
    if std::env::var_os("CARGO_FEATURE_WGPU").is_some()
        && matches!(system.as_deref(), Ok("linux" | "windows"))
    {
        println!("cargo::rustc-cfg=vulkan");
    }
    let header = std::fs::read_to_string(HEADER)?;
    let abi = header.lines().find_map(|line| line.strip_prefix("#define TEXERE_ABI "));
    let abi: u32 = abi.ok_or("include/texere.h has no TEXERE_ABI")?.parse()?;
    if system.as_deref() == Ok("linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libtexere_c.so.{abi}");
    }
    Ok(())
}
