//! Gives the shared library a soname with the number of the binary interface: a program then finds
//! the library that it was built for, even if others are installed beside it. Sets the
//! configuration `vulkan` if the library can lend objects of Vulkan.

use std::error::Error;

/// The header, which is generated from the sources. It has the number of the binary interface.
const HEADER: &str = "include/texere.h";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed={HEADER}");
    // `vulkan` is set below for Linux and Windows, where the library can lend objects of Vulkan.
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
