// What texere.hpp promises beyond texere.h: exceptions, moves, callbacks, views.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

#include "texere.hpp"

#define CHECK(what) \
    if (!(what)) std::printf("line %d: %s\n", __LINE__, #what), std::exit(1)

template <class Call>
static texere::Error thrown(Call call) {
    try {
        call();
    } catch (const texere::Error &error) {
        return error;
    }
    std::puts("nothing was thrown");
    std::exit(1);
}

using Bytes = std::vector<std::uint8_t>;

static Bytes bytes(std::string_view text) { return Bytes(text.begin(), text.end()); }

int main() {
    const Bytes wrong = bytes("weave = { notation = \"plain\", ends = 4, picks = 4 }\nyarns.a.tex = -3\n");
    auto refused = thrown([&] { texere::Design("wrong.toml", wrong); });
    CHECK(refused.status() == TEXERE_DESIGN && refused.file() == "wrong.toml" && refused.line() == 2);
    CHECK(std::string_view(refused.what()).find("yarns.a.tex") != std::string_view::npos);

    // What a callback throws is thrown by the call.
    const Bytes pictured = bytes("weave.image = \"a.png\"\n");
    try {
        texere::Design("pictured.toml", pictured, [](std::string_view path) {
            CHECK(path == "a.png");
            return path.empty() ? std::optional<texere::view<const std::uint8_t>>() : throw 7;
        });
        CHECK(false);
    } catch (int number) {
        CHECK(number == 7);
    }
    CHECK(thrown([&] { texere::Design("pictured.toml", pictured); }).status() == TEXERE_IO);

    // A handle has one owner.
    static_assert(!std::is_copy_constructible_v<texere::Device> && !std::is_copy_assignable_v<texere::Device>);
    static_assert(std::is_nothrow_move_constructible_v<texere::Device>);
    texere::Device device("cpu"), other("cpu-serial");
    const auto *own = device.get();
    other = std::move(device);
    CHECK(other.get() == own && !device.get());
    CHECK(thrown([&] { device.describe(); }).status() == TEXERE_ARGUMENT);
    CHECK(std::string_view(other.describe().name) == "cpu");

    // Views are made of what has data and a size, and never add the right to write.
    static_assert(!std::is_constructible_v<texere::view<int>, const std::vector<int> &>);
    std::array<std::uint64_t, 2> offsets{0, 2};
    std::vector<texere_point> points{{0, 0, 0, .1f, .1f}, {1, 0, 0, .1f, .1f}};
    auto arrays = texere::sized<texere_yarn_arrays>();
    arrays.yarns = 1;
    arrays.offsets = offsets.data();
    arrays.points = points.data();
    texere::Yarns yarns(arrays);
    std::vector<texere_point> copied(yarns.counts().points);
    yarns.points(offsets, copied);
    CHECK(copied[1].x == 1 && texere::view<const texere_point>(copied).size() == 2);
#if defined(__cpp_lib_span)
    std::span<texere_point> span = texere::view<texere_point>(copied);
    CHECK(texere::view<const texere_point>(span).data() == copied.data());
#endif

    auto settings = yarns.settings();
    texere::Plan plan(yarns, other, &settings);
    std::vector<texere_vertex> vertices(1);
    auto small = thrown([&] { plan.mesh(vertices, {}); });
    CHECK(small.status() == TEXERE_ARGUMENT && small.file().empty());
    // Pieces and files hold what the mesh holds.
    std::vector<std::uint32_t> indices;
    plan.mesh_vectors(vertices, indices);
    std::vector<float> placed(vertices.size() * 3);
    auto apart = texere::sized<texere_mesh_arrays>();
    apart.positions = {placed.data(), placed.size() * sizeof(float), 3 * sizeof(float)};
    plan.mesh(apart);
    std::size_t taken = 0;
    plan.stream([&](const texere_piece &piece) {
        for (const auto &vertex : texere::view(piece.vertices, piece.vertex_count)) {
            CHECK(vertex.position[2] == vertices[taken].position[2]);
            CHECK(vertex.position[1] == placed[taken++ * 3 + 1]);
        }
    });
    CHECK(taken == vertices.size());
    std::uint64_t size = 0;
    plan.write_to(TEXERE_FORMAT_PLY, [&](std::uint64_t offset, texere::view<const std::uint8_t> bytes) {
        size = std::max(size, offset + bytes.size());
    });
    CHECK(size > taken * sizeof(texere_vertex));
    try {
        plan.stream([](const texere_piece &) { throw 7; });
        CHECK(false);
    } catch (int number) {
        CHECK(number == 7);
    }
    texere::Run run;
    run.cancel();
    CHECK(thrown([&] { plan.mesh_vectors(vertices, indices, &run); }).status() == TEXERE_CANCELLED);
    CHECK(run.progress() < 1 && plan.draws().size() == plan.counts().draws);
}
