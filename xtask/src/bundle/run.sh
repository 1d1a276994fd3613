#!/bin/sh
# Tests and measures texere on all devices of this machine. The report goes to the folder given, or else to ./report, and
# to standard output. It needs nothing but drivers: loaders are in lib.
here=$(cd "$(dirname "$0")" && pwd)
report=${1:-report}
mkdir -p "$report" && report=$(cd "$report" && pwd) || exit 1

has() { ldconfig -p | grep -q "$1"; }
# The system's own loaders come first where it has both.
if ! has libOpenCL.so.1 || ! has libvulkan.so.1; then
    export LD_LIBRARY_PATH="${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$here/lib"
fi
# Drivers that no loader was told of.
if has libnvidia-opencl.so.1 && ! grep -qs nvidia /etc/OpenCL/vendors/*.icd; then
    export OCL_ICD_FILENAMES="libnvidia-opencl.so.1${OCL_ICD_FILENAMES:+:$OCL_ICD_FILENAMES}"
fi
if [ -z "$VK_DRIVER_FILES" ] && has libGLX_nvidia.so.0 && ! ls /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json >/dev/null 2>&1; then
    export VK_DRIVER_FILES="$here/nvidia_icd.json"
fi

# `designs` is looked for in the working folder.
cd "$here" || exit 1
failed=0
{
    echo "# texere on $(uname -sm)"
    echo
    echo "\`run\` of the bundle at commit $(cat commit)."
    echo
    echo '```text'
    bin/texere devices
    echo '```'
    echo
    echo "## Conformance"
    echo
    echo '```text'
    bin/conformance --test-threads 8 >"$report/conformance.txt" 2>&1 || failed=1
    grep -E '^test result|FAILED$' "$report/conformance.txt"
    echo '```'
    echo
    echo "## Against the floor"
    echo
    bin/texere-bench floor --rounds 9 || failed=1
    echo
    bin/texere-bench tables --heading "\`run\` of the bundle at commit $(cat commit)." -o "$report" 2>"$report/tables.txt" || failed=1
    [ -f "$report/BENCHMARKS.md" ] && sed 's/^#/##/' "$report/BENCHMARKS.md"
    [ "$failed" = 0 ] || echo "Something failed: see above."
} | tee "$report/REPORT.md"
