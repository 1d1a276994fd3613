// Tests what texere.hpp adds to texere.h: exceptions, moves, callbacks and views.
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

// Woven cloth: an edit, the parts that it changes, the hit of a ray, and the measures.
static void live_cloth(const texere::Device &device) {
    const Bytes plain = bytes("weave = { notation = \"plain\", ends = 6, picks = 6 }\nfinish.settle = false\n"
                              "yarns.a.diameter_mm = 0.2\nwarp = { yarns = [\"a\"], spacing_mm = 0.5 }\n"
                              "weft = { yarns = [\"a\"], spacing_mm = 0.5 }\n");
    texere::Cloth cloth(texere::Design("plain.toml", plain));
    CHECK(cloth.measures().width == 3 && cloth.measures().loops == 0);
    texere::Check tried(cloth);
    CHECK(tried.diagnosis().clean == (std::string_view(tried.diagnosis().words) == "clean"));
    CHECK(tried.json()[0] == '{' && tried.measures_json()[0] == '{');

    texere::Live live(cloth, device);
    CHECK(live.update().anew == 1);
    std::vector<texere_vertex> vertices(live.counts().vertices), again(vertices.size());
    std::vector<std::uint32_t> indices(live.counts().indices);
    live.mesh(vertices, indices);
    const bool up = live.lift(2, 3);
    live.set_lift(2, 3, !up);
    CHECK(live.lift(2, 3) != up && live.draws().size() == live.counts().draws);
    const texere_update update = live.update();
    CHECK(update.anew == 0 && update.change_count > 0);
    for (const texere_change &change : texere::view(update.changes, update.change_count)) {
        texere::view<texere_vertex> own(vertices.data() + change.first_vertex, change.vertex_count);
        live.read(change, own, {indices.data() + change.first_index, change.index_count});
    }
    live.mesh(again, indices);
    CHECK(std::equal(again.begin(), again.end(), vertices.begin(), [](const auto &one, const auto &other) {
        return std::equal(one.position, one.position + 3, other.position);
    }));
    // From above the middle of end 3 at pick 4.
    const texere_ray down{{1.25, 1.75, 10}, {0, 0, -1}};
    const texere_hit hit = texere::Picker(live.yarns()).pick(down);
    CHECK(hit.found && live.pick(down).yarn == hit.yarn && live.pick(down).distance == hit.distance);
    CHECK(live.place(hit) == "end 3 at pick 4, a");
    const texere_hit other = texere::Picker(cloth.yarns()).pick(down);
    CHECK(other.yarn != hit.yarn && cloth.place(other) == "pick 4 at end 3, a");
    CHECK(!live.pick({{1.25, 1.75, 10}, {0, 0, 1}}).found);
}

// A picture: one yarn across the ground.
static void pictured() {
    const std::array<std::uint64_t, 2> offsets{0, 2};
    const std::array<texere_point, 2> points{{{0, 0, 0, .1f, .1f}, {1, 0, 0, .1f, .1f}}};
    auto arrays = texere::sized<texere_yarn_arrays>();
    arrays.yarns = 1;
    arrays.offsets = offsets.data();
    arrays.points = points.data();
    texere::Renderer renderer;
    auto picture = texere::Renderer::usual();
    picture.width = 40, picture.height = 30;
    Bytes pixels(40 * 30 * 4);
    CHECK(thrown([&] { renderer.picture(picture, pixels); }).status() == TEXERE_ARGUMENT);
    renderer.show(texere::Yarns(arrays));
    renderer.picture(picture, pixels);
    CHECK(pixels[3] == 255 && !std::equal(pixels.begin(), pixels.begin() + 4, &pixels[(15 * 40 + 20) * 4]));
    Bytes small(7);
    CHECK(thrown([&] { renderer.picture(picture, small); }).status() == TEXERE_ARGUMENT);
}

// With an argument the program only makes the picture, apart because drivers leak memory.
int main(int count, char **) {
    if (count > 1) return pictured(), 0;
    const Bytes wrong = bytes("weave = { notation = \"plain\", ends = 4, picks = 4 }\nyarns.a.tex = -3\n");
    auto refused = thrown([&] { texere::Design("wrong.toml", wrong); });
    CHECK(refused.status() == TEXERE_DESIGN && refused.file() == "wrong.toml" && refused.line() == 2);
    CHECK(std::string_view(refused.what()).find("yarns.a.tex") != std::string_view::npos);

    // An exception of a callback leaves the call.
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

    // A view can be made of any container with data and a size, but not a writable view of const values.
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
    // Pieces and files have the same vertices and indices as the mesh.
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
    // A handle without a class has an owner, too. The call fails, because `cpu` has no buffers to lend.
    using Session = texere::Owner<texere_session, texere_session_free>;
    auto lent = thrown([&] { Session(texere_session_new, plan.get(), nullptr); });
    CHECK(lent.status() == TEXERE_UNSUPPORTED);
    live_cloth(other);
}
