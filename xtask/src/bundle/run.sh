#!/bin/sh
# Tests and measures texere on all devices of this machine. The report goes to the folder given, or else to ./report, and
# to standard output. It needs nothing but drivers: loaders are in lib.
here=$(cd "$(dirname "$0")" && pwd)
report=${1:-report}
mkdir -p "$report" && report=$(cd "$report" && pwd) || exit 1

# Where a library lies that the system's cache may not know of yet.
find_library() {
    found=$(ldconfig -p | awk -v name="$1" '$1 == name { print $NF; exit }')
    [ -n "$found" ] || found=$(ls /usr/local/nvidia/lib*/"$1" /usr/lib/*/"$1" /usr/lib64/"$1" 2>/dev/null | head -n 1)
    [ -n "$found" ]
}
# The system's own loaders come first where it has both.
if ! find_library libOpenCL.so.1 || ! find_library libvulkan.so.1; then
    export LD_LIBRARY_PATH="${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$here/lib"
fi
# Drivers of NVIDIA's that no loader was told of.
if ! grep -qs nvidia /etc/OpenCL/vendors/*.icd && find_library libnvidia-opencl.so.1; then
    mkdir -p "$report/vendors"
    cp /etc/OpenCL/vendors/*.icd "$report/vendors" 2>/dev/null
    echo "$found" >"$report/vendors/nvidia.icd"
    export OCL_ICD_VENDORS="$report/vendors"
    export LD_LIBRARY_PATH="${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$(dirname "$found")"
fi
if [ -z "$VK_DRIVER_FILES" ] && ! grep -qs nvidia /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json &&
    find_library libGLX_nvidia.so.0; then
    export VK_DRIVER_FILES="$here/nvidia_icd.json"
    export LD_LIBRARY_PATH="${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$(dirname "$found")"
fi

# `designs` is looked for in the working folder.
cd "$here" || exit 1
rm -f "$report/failed"
# What follows runs in a shell of its own, so a failure is noted in a file.
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
    bin/conformance --test-threads 8 >"$report/conformance.txt" 2>&1 || : >"$report/failed"
    grep -E '^test result|FAILED$' "$report/conformance.txt"
    echo '```'
    echo
    echo "## Against the floor"
    echo
    bin/texere-bench floor --rounds 9 || : >"$report/failed"
    echo
    bin/texere-bench tables --heading "\`run\` of the bundle at commit $(cat commit)." -o "$report" 2>"$report/tables.txt" || : >"$report/failed"
    [ -f "$report/BENCHMARKS.md" ] && sed 's/^#/##/' "$report/BENCHMARKS.md"
    [ ! -e "$report/failed" ] || echo "Something failed: see above."
} | tee "$report/REPORT.md"
[ ! -e "$report/failed" ]
