// A design to an OBJ file: obj DESIGN DEVICE OUTPUT.
#include <cstdio>
#include <iostream>
#include <memory>

#include "texere.hpp"

struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
};

static void write(const texere::Plan &plan, std::FILE *file) {
    std::vector<texere_vertex> vertices;
    std::vector<std::uint32_t> indices;
    plan.mesh_vectors(vertices, indices);
    for (const texere_vertex &vertex : vertices) {
        const float *at = vertex.position, *normal = vertex.normal;
        std::fprintf(file, "v %.9g %.9g %.9g\nvn %.9g %.9g %.9g\n", at[0], at[1], at[2], normal[0], normal[1],
                     normal[2]);
    }
    for (const texere_draw &draw : plan.draws()) {
        std::fprintf(file, "g yarn%u\n", draw.yarn + 1);
        texere::view<const std::uint32_t> corners(indices.data() + draw.first_index, draw.index_count);
        for (std::size_t first = 0; first < corners.size(); first += 3) {
            std::fputc('f', file);
            for (std::size_t corner = first; corner < first + 3; corner++) {
                // OBJ counts from 1.
                auto number = static_cast<unsigned long long>(draw.base_vertex + corners[corner] + 1);
                std::fprintf(file, " %llu//%llu", number, number);
            }
            std::fputc('\n', file);
        }
    }
}

int main(int count, char **arguments) try {
    if (count != 4 || texere_abi() != TEXERE_ABI) return 1;
    texere::Device device(arguments[2]);
    texere::Cloth cloth(texere::Design(arguments[1]), device);
    texere::Plan plan(cloth.yarns(), device);
    std::unique_ptr<std::FILE, Close> file(std::fopen(arguments[3], "w"));
    if (!file) return 1;
    write(plan, file.get());
    std::cout << cloth.report().words << ": " << plan.counts().triangles << " triangles\n";
} catch (const texere::Error &error) {
    if (error.line()) std::cerr << error.file() << ":" << error.line() << ": ";
    std::cerr << error.what() << "\n";
    return error.status();
}
