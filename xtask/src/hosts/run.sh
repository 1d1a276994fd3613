# Builds the examples below PREFIX as its users do, with the system's compilers and nothing else, and runs them in the
# folder OUT. They make what the program TEXERE makes, to the bit.
set -eu
examples=$PREFIX/share/texere/examples designs=$PWD/designs
capi=$PWD/crates/texere-capi kept=$PWD/xtask/src/hosts/kept.supp
export PKG_CONFIG_PATH="$PREFIX/lib/pkgconfig"
cd "$OUT"
# All memory is freed, but for what kept.supp explains. Valgrind has no AVX-512, and the library sees that.
watched() {
    valgrind --quiet --leak-check=full --show-leak-kinds=all --errors-for-leak-kinds=all "--suppressions=$kept" \
        --error-exitcode=99 "$@"
}
set -x

# The number of the binary interface is the same everywhere.
abi=$(sed -n 's/^#define TEXERE_ABI //p' "$PREFIX/include/texere.h")
test "$(readlink "$PREFIX/lib/libtexere_c.so")" = "libtexere_c.so.$abi"
readelf --dynamic "$PREFIX/lib/libtexere_c.so" | grep "SONAME.*\[libtexere_c.so.$abi\]"
grep "libtexere_c.so.$abi\"" "$PREFIX/lib/cmake/texere/texere-config.cmake"

for example in mesh yarns edit; do
    cc -std=c99 -Wall -Wextra -Werror -pedantic "$examples/$example.c" -o $example \
        $(pkg-config --cflags --libs texere) "-Wl,-rpath,$PREFIX/lib"
done
cmake -S "$examples/obj" -B obj "-DCMAKE_PREFIX_PATH=$PREFIX" "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror -pedantic"
cmake --build obj
assembly=$PREFIX/share/texere/nuget/lib/netstandard2.1
for example in weave picture; do
    mcs -langversion:latest -warnaserror "-r:$assembly/Texere.dll" "$examples/$example.cs" -out:$example.exe
done
# What the classes for C++ and C# promise.
for standard in 17 20; do
    for program in wrappers classes; do
        c++ -std=c++$standard -Wall -Wextra -Wshadow -Werror -pedantic "$capi/tests/hosts/$program.cpp" -o $program \
            $(pkg-config --cflags --libs texere) "-Wl,-rpath,$PREFIX/lib"
        watched ./$program
    done
    ./wrappers picture
    ./classes wgpu
done
for program in wrappers classes; do
    mcs -langversion:latest -unsafe "-recurse:$capi/csharp/*.cs" "$capi/tests/hosts/$program.cs" -out:$program.exe
done
LD_LIBRARY_PATH="$PREFIX/lib" mono wrappers.exe
LD_LIBRARY_PATH="$PREFIX/lib" mono classes.exe wgpu

for design in poplin jersey tricot; do
    "$TEXERE" mesh "$designs/$design.toml" --device cpu -o $design.ply
    ./mesh "$designs/$design.toml" cpu mesh.ply
    cmp $design.ply mesh.ply
done
watched ./mesh "$designs/jersey.toml" cpu watched.ply
cmp jersey.ply watched.ply
watched ./yarns two.yarns
watched obj/obj "$designs/tricot.toml" cpu tricot.obj
obj/obj_static "$designs/tricot.toml" cpu static.obj
cmp tricot.obj static.obj
"$TEXERE" mesh "$designs/herringbone.wif" --device cpu -o herringbone.ply
"$TEXERE" mesh "$designs/poplin.toml" --no-settle --device cpu -o placed.ply
watched ./edit "$designs/poplin.toml" cpu undone.bin
export LD_LIBRARY_PATH="$PREFIX/lib" MONO_PATH="$assembly"
mono weave.exe "$designs/herringbone.wif" cpu herringbone.bin
mono picture.exe "$designs/herringbone.wif" cpu herringbone.bmp
# A header of 54 bytes and four a pixel, which have more than a few colours.
test "$(wc -c < herringbone.bmp)" = $((54 + 4 * 640 * 480))
test "$(tail -c +55 herringbone.bmp | od -An -v -tx4 -w4 | sort -u | wc -l)" -gt 100
