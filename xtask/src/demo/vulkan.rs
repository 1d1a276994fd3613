//! Installs a Vulkan driver if there is none.

use std::fs;

use crate::steps::Steps;

/// The folders where drivers are registered, on Linux.
const DRIVER_FOLDERS: [&str; 3] =
    ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];

/// Debian's packages for drawing on a CPU: a Vulkan loader and lavapipe.
pub(crate) const PACKAGES: [&str; 2] = ["libvulkan1", "mesa-vulkan-drivers"];

/// Installs lavapipe if there is no Vulkan driver. If the user may not install packages, prints
/// their names instead. Metal and Direct3D 12 come with their systems.
pub(crate) fn install(steps: &mut Steps) {
    if !cfg!(target_os = "linux") || has_driver() {
        return;
    }
    let is_root = steps.succeeds("test", &["-w", "/var/lib/dpkg"]);
    let may_sudo = steps.succeeds("sudo", &["--non-interactive", "true"]);
    if !steps.succeeds("apt-get", &["--version"]) || !(is_root || may_sudo) {
        eprintln!("No Vulkan driver was found. Install one: on Debian and Ubuntu");
        eprintln!("    sudo apt-get install {}", PACKAGES.join(" "));
        eprintln!("on Fedora mesa-vulkan-drivers, on Arch vulkan-swrast.");
        return;
    }
    steps.install("a Vulkan driver that draws on the CPU", &PACKAGES);
}

fn has_driver() -> bool {
    let configured =
        ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].iter().any(|name| std::env::var_os(name).is_some());
    let holds_any =
        |folder: &&str| fs::read_dir(folder).is_ok_and(|mut entries| entries.any(|entry| entry.is_ok()));
    configured || DRIVER_FOLDERS.iter().any(holds_any)
}
