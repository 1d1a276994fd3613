// From a design to an OBJ file, piece by piece in bounded memory: obj DESIGN DEVICE OUTPUT.
#include <cstdio>
#include <iostream>
#include <memory>

#include "texere.hpp"

struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
};

static void write(const texere_piece &piece, std::FILE *file) {
    for (const texere_vertex &vertex : texere::view(piece.vertices, piece.vertex_count)) {
        const float *at = vertex.position, *normal = vertex.normal;
        std::fprintf(file, "v %.9g %.9g %.9g\nvn %.9g %.9g %.9g\n", at[0], at[1], at[2], normal[0], normal[1],
                     normal[2]);
    }
    for (std::uint64_t number = 0; number < piece.index_count; number++) {
        // A piece may end within a triangle.
        bool first = (piece.first_index + number) % 3 == 0, last = (piece.first_index + number) % 3 == 2;
        // OBJ files count vertices from 1.
        auto vertex = static_cast<unsigned long long>(piece.base_vertex + piece.indices[number] + 1);
        std::fprintf(file, "%s%llu//%llu%s", first ? "f " : " ", vertex, vertex, last ? "\n" : "");
    }
}

int main(int count, char **arguments) try {
    if (count != 4 || texere_abi() != TEXERE_ABI) return 1;
    texere::Device device(arguments[2]);
    texere::Cloth cloth(texere::Design(arguments[1]), device);
    texere::Plan plan(cloth.yarns(), device);
    std::unique_ptr<std::FILE, Close> file(std::fopen(arguments[3], "w"));
    if (!file) return 1;
    plan.stream([&](const texere_piece &piece) { write(piece, file.get()); });
    std::cout << cloth.report().words << ": " << plan.counts().triangles << " triangles\n";
} catch (const texere::Error &error) {
    if (error.line()) std::cerr << error.file() << ":" << error.line() << ": ";
    std::cerr << error.what() << "\n";
    return error.status();
}
