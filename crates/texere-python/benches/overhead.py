"""What Python adds to the time of a mesh, and of meshes in eight threads, beside Rust in one run.

    cargo build --release -p texere-bench --bin beside
    pip install ./crates/texere-python
    python crates/texere-python/benches/overhead.py target/release/beside [ENDS PICKS ROUNDS]

The cloth is a 3/1 twill with one control point at each crossing, as in the other benches, with the
sides and subdivisions that Rust takes by default, on the device cpu. Each round has Rust, Python,
Python and Rust make the mesh and free it. Prints the medians and the median of the rounds' ratios,
then the least times and their ratio. Then eight threads make the meshes of eight cloths, each cloth
with about an eighth of the ends. Last comes the time of `import texere` after `import numpy`, in
processes of their own.
"""

import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import texere

THREADS = 8


def twill(ends, picks):
    yarn = texere.Yarn(diameter_mm=0.25)
    drawdown = texere.weave("3/1", ends, picks)
    design = texere.woven(drawdown, yarn, yarn, warp_mm=0.75, weft_mm=0.75, shape="crossing")
    return design.placed().yarns


def seconds(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def compare(name, program, cloths, rounds):
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{number}.yarns" for number in range(len(cloths))]
        for file, yarns in zip(files, cloths):
            yarns.write(file)
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True, "bufsize": 1}
        rust = subprocess.Popen([program, *files], **pipes)
        sides, subdivisions = map(int, rust.stdout.readline().split())

        def by_rust():
            rust.stdin.write(f"{len(cloths)}\n")
            return float(rust.stdout.readline())

        def mesh(yarns):
            yarns.mesh(sides, subdivisions, device="cpu")

        def by_python():
            if len(cloths) == 1:
                return seconds(lambda: mesh(cloths[0]))
            running = [threading.Thread(target=mesh, args=[yarns]) for yarns in cloths]

            def work():
                for thread in running:
                    thread.start()
                for thread in running:
                    thread.join()

            return seconds(work)

        # The first meshes are not counted: they touch memory that later meshes use again.
        by_rust(), by_python()
        times = {"rust": [], "python": []}
        ratios = []
        for _ in range(rounds):
            first, one, two, last = by_rust(), by_python(), by_python(), by_rust()
            times["rust"] += [first, last]
            times["python"] += [one, two]
            ratios.append((one + two) / (first + last))
        rust.stdin.close()
        rust.wait()
    medians = {language: statistics.median(values) for language, values in times.items()}
    least = {language: min(values) for language, values in times.items()}
    print(
        f"{name}: Rust {medians['rust']:.4f} s, Python {medians['python']:.4f} s, "
        f"ratio {statistics.median(ratios):.3f}; least {least['rust']:.4f} s and {least['python']:.4f} s, "
        f"ratio {least['python'] / least['rust']:.3f}",
        flush=True,
    )


def imported(names):
    """The time of imports in a fresh process, seconds: the least of ten."""
    code = f"import time; s = time.perf_counter(); import {names}; print(time.perf_counter() - s)"
    runs = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True) for _ in range(10)]
    return min(float(run.stdout) for run in runs)


def main():
    program = sys.argv[1]
    ends, picks, rounds = map(int, sys.argv[2:] or (815, 750, 9))
    compare(f"{ends} x {picks}", program, [twill(ends, picks)], rounds)
    parts = [twill(ends // THREADS + number, picks - number) for number in range(THREADS)]
    compare(f"{THREADS} threads, about {ends // THREADS} x {picks} each", program, parts, rounds)
    numpy, both = imported("numpy"), imported("numpy, texere")
    print(f"import numpy {1e3 * numpy:.0f} ms, then texere {1e3 * (both - numpy):.0f} ms")


if __name__ == "__main__":
    main()
