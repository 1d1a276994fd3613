// Tests the classes of texere.hpp against one another: designs from arrays, files in memory, every edit
// of live cloth. With an argument, which names a device that lends its buffers, it tests a session.
#include <array>
#include <cstring>

#include "expect.hpp"

// A round thread, in mm. All else is as where nothing is said.
texere_thread round_thread(double spacing, double diameter) {
    texere_thread thread{};
    thread.spacing_mm = spacing;
    thread.diameter_mm = diameter;
    return thread;
}

// A twill of 6 ends and 4 picks on 4 shafts, as arrays that live as long as this.
struct Twill {
    std::vector<texere_thread> threads{6, round_thread(.5, .2)};
    std::vector<std::uint32_t> threading{1, 2, 3, 4, 1, 2}, tied{1, 2, 2, 3, 3, 4, 4, 1}, pressed{1, 2, 3, 4};
    std::vector<std::uint64_t> tie_up{0, 2, 4, 6, 8};
    texere_draft draft = texere::sized<texere_draft>();
    texere_woven woven = texere::sized<texere_woven>();

    Twill() {
        draft.shafts = draft.treadles = 4;
        draft.threading.numbers = threading.data();
        draft.tie_up = {tied.data(), tie_up.data()};
        draft.treadling.numbers = pressed.data();
        woven.ends = 6, woven.picks = 4;
        woven.warp = woven.weft = threads.data();
        woven.draft = &draft;
    }
};

static texere::Design placed(const texere::Design &design) {
    auto finish = design.finish();
    finish.settle = 0;
    return design.finished(finish);
}

static bool same(const texere::Yarns &one, const texere::Yarns &other) {
    Bytes first, second;
    one.write_to(TEXERE_YARNS_FORMAT_YARNS, texere::into(first));
    other.write_to(TEXERE_YARNS_FORMAT_YARNS, texere::into(second));
    return !first.empty() && first == second;
}

static void designs() {
    Twill twill;
    const texere::Design design(twill.woven);
    Bytes wif, toml, png;
    design.write_to(TEXERE_DESIGN_FORMAT_WIF, texere::into(wif));
    design.write_to(TEXERE_DESIGN_FORMAT_TOML, texere::into(toml));
    CHECK(std::string_view(reinterpret_cast<const char *>(wif.data()), wif.size()).find("[TIEUP]") != std::string::npos);
    const texere::Cloth cloth(placed(design)), again(placed(texere::Design("again.toml", toml)));
    CHECK(same(cloth.yarns(), again.yarns()));
    design.draft_to(texere::into(png));
    CHECK(png.size() > 8 && std::memcmp(png.data() + 1, "PNG", 3) == 0);
    try {
        design.write_to(TEXERE_DESIGN_FORMAT_WIF, [](std::uint64_t, texere::view<const std::uint8_t>) { throw 7; });
        CHECK(false);
    } catch (int number) {
        CHECK(number == 7);
    }
    twill.threading[2] = 5;
    const auto refused = thrown([&] { texere::Design(twill.woven); });
    CHECK(refused.status() == TEXERE_ARGUMENT);
    CHECK(std::string_view(refused.what()) == "woven.draft.threading.numbers[2] is 5, expected 0 to 4");

    Bytes saved;
    cloth.yarns().write_to(TEXERE_YARNS_FORMAT_YARNS, texere::into(saved));
    CHECK(same(texere::Yarns("saved.yarns", saved), cloth.yarns()));
    saved.pop_back();
    CHECK(thrown([&] { texere::Yarns("saved.yarns", saved); }).file() == "saved.yarns");
    std::vector<double> lengths(cloth.measures().materials);
    cloth.lengths(lengths);
    CHECK(lengths.size() == 1 && lengths[0] > 6 * 2);
}

// An edit, which changes the yarns. What undoes it gives the yarns of before.
template <class Edit, class Undo>
static void edited(texere::Live &live, Edit edit, Undo undo) {
    const texere::Yarns before = live.yarns();
    edit();
    CHECK(!same(live.yarns(), before));
    live.update();
    undo();
    CHECK(same(live.yarns(), before));
}

static void edits() {
    const Twill twill;
    const texere::Device device("cpu");
    const texere::Design design = placed(texere::Design(twill.woven));
    const texere::Cloth cloth(design);
    texere::Live live(cloth, device);
    live.update();
    std::vector<std::uint64_t> offsets(cloth.yarns().counts().yarns + 1);
    std::vector<texere_point> points(cloth.yarns().counts().points);
    cloth.yarns().points(offsets, points);
    const texere::view<texere_point> first(points.data(), offsets[1]);
    auto bent = std::vector<texere_point>(first.begin(), first.end());
    bent[1].z += .1f;
    const texere_yarn what = live.yarn(0);
    auto twisted = what;
    twisted.twist = .5f;
    edited(live, [&] { live.set_points(0, bent); }, [&] { live.set_points(0, first); });
    edited(live, [&] { live.set_yarn(0, twisted, first); }, [&] { live.set_yarn(0, what, first); });
    edited(live, [&] { live.set_tension(.3f); }, [&] { live.set_tension(0); });

    texere_material red = live.material(0);
    const std::array<std::uint8_t, 3> before{red.srgb[0], red.srgb[1], red.srgb[2]};
    red.srgb[0] ^= 0x40;
    edited(live, [&] { live.set_material(0, red); }, [&] {
        texere_material material = live.material(0);
        std::copy(before.begin(), before.end(), material.srgb);
        live.set_material(0, material);
    });

    // Lifts one by one, and as a block of 2 ends and 3 picks.
    texere::Live other(cloth, device);
    Bytes block;
    for (std::uint64_t pick = 1; pick < 4; ++pick) {
        for (std::uint64_t end = 2; end < 4; ++end) {
            block.push_back(!live.lift(end, pick));
            other.set_lift(end, pick, block.back());
        }
    }
    live.set_drawdown(2, 2, 1, block);
    CHECK(same(live.yarns(), other.yarns()) && !same(live.yarns(), cloth.yarns()));
    block.pop_back();
    try {
        live.set_drawdown(2, 2, 1, block);
        CHECK(false);
    } catch (const std::invalid_argument &) {
    }
    live.set_rest(cloth.yarns());
    CHECK(same(live.yarns(), cloth.yarns()));
    live.set_structure(design);
    CHECK(live.lift(2, 1) != other.lift(2, 1) && live.lift(0, 0) == other.lift(0, 0));
    live.set_yarns(other.yarns());
    CHECK(same(live.yarns(), other.yarns()));
    CHECK(thrown([&] { live.set_lift(0, 0, true); }).status() == TEXERE_ARGUMENT);

    // Yarns that the library was given have no weave either.
    texere::Live given(cloth.yarns(), device);
    CHECK(thrown([&] { given.lift(0, 0); }).status() == TEXERE_ARGUMENT);
    std::vector<texere_attribute> attributes(given.counts().vertices);
    CHECK(thrown([&] { given.attributes(attributes); }).status() == TEXERE_ARGUMENT);
    given.keep_attributes();
    const texere_update update = given.update();
    CHECK(update.change_count > 0);
    attributes.resize(given.counts().vertices);
    given.attributes(attributes);
    const texere_change &change = update.changes[update.change_count - 1];
    std::vector<texere_attribute> part(change.vertex_count);
    given.read_attributes(change, part);
    CHECK(part[0].yarn == attributes[change.first_vertex].yarn && part[0].along == attributes[change.first_vertex].along);
    texere::Run run;
    run.cancel();
    given.set_tension(.2f);
    CHECK(thrown([&] { given.update(&run); }).status() == TEXERE_CANCELLED);
    given.update();

    const texere::Plan plan(cloth.yarns(), device);
    CHECK(plan.ring_offsets().size() == plan.draws().size() + 1 && plan.ring_offsets().end()[-1] == plan.counts().rings);
    CHECK(plan.chunk(0).vertex_count == plan.counts().vertices && plan.counts().chunks == 1);
}

// A chunk that stays on a device has the mesh of its plan.
static void session(const char *name) {
    const Twill twill;
    const texere::Cloth cloth(placed(texere::Design(twill.woven)));
    const texere::Device device(name);
    const texere::Plan plan(cloth.yarns(), device);
    std::vector<texere_vertex> vertices, lent;
    std::vector<std::uint32_t> indices, own;
    plan.mesh_vectors(vertices, indices);
    texere::Session session(plan);
    CHECK(session.native().struct_size == sizeof(texere_native));
    const texere_device_mesh mesh = session.mesh(0);
    CHECK(mesh.struct_size == sizeof mesh);
    session.wait();
    lent.resize(vertices.size()), own.resize(indices.size());
    session.read(0, lent, own);
    CHECK(own == indices && std::memcmp(lent.data(), vertices.data(), lent.size() * sizeof lent[0]) == 0);
    CHECK(thrown([&] { session.mesh(1); }).status() == TEXERE_ARGUMENT);
}

int main(int count, char **arguments) {
    if (count > 1) return session(arguments[1]), 0;
    designs();
    edits();
}
