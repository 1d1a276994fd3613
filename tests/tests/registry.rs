//! The devices that the registry opens on this machine.

use texere_conformance::REGISTRY;
use texere_core::backend::Schedule;

/// If a GPU backend has devices on this machine, one of them has a clock, and each schedule is
/// opened.
#[test]
fn every_gpu_backend_has_a_device_with_a_clock_and_both_schedules() {
    for name in ["opencl", "wgpu"] {
        let entry = REGISTRY.iter().find(|entry| entry.name == name).unwrap();
        let (devices, _) = entry.devices();
        // The suite itself reports a missing backend.
        if devices.is_empty() {
            continue;
        }
        assert!(devices.iter().any(|device| device.info().timed_by_device), "{devices:?}");
        for schedule in [Schedule::PerRing, Schedule::PerYarn] {
            assert!(devices.iter().any(|device| device.info().schedule == schedule), "{devices:?}");
        }
    }
}
