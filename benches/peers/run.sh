#!/bin/sh
# Sets up and runs texere and its peers on the same yarns, one after the other: run.sh [ENDS PICKS [ROUNDS]]
# It needs cargo, python3 with venv, node and npm. Everything it fetches and writes lies under target/peers.
set -eu
cd "$(dirname "$0")/../.."
ends=${1:-489} picks=${2:-450} rounds=${3:-3}
work=$PWD/target/peers
mkdir -p "$work"

[ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check numpy==1.26.4 vtk==9.7.2
cp benches/peers/tube.mjs "$work/"
(cd "$work" && npm install --silent --no-save --no-package-lock three@0.187.0)
cargo build --release --locked --package texere-bench --bins

target/release/polylines "$ends" "$picks" "$work"
echo "$ends x $picks, $(uname -sr), $(sed -n 's/^model name.*: //p' /proc/cpuinfo 2>/dev/null | head -1)"
uptime
for tool in vtk vtk-triangles numpy; do
  "$work/venv/bin/python" benches/peers/tube.py "$work" "$tool" "$rounds"
done
(cd "$work" && node --max-old-space-size=8192 tube.mjs "$work" 1)
target/release/shares "$ends" "$picks" "$rounds"
uptime
