// texere for C++17: classes over texere.h that own their handles and free them, and exceptions.
//
// An object of a class with a handle owns the handle. It can be moved but not copied. A function
// that fails throws texere::Error. For what a function of a class does, see the function of
// texere.h that it calls: texere.h describes units, threads, and how long lent memory is valid.
//
// Meshes and points go to memory of the caller's. They go to vectors only if the name of the
// function says so. A program may also call a function of texere.h with `get()` of an object, and
// pass the status to `texere::check`.

#ifndef TEXERE_HPP
#define TEXERE_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "texere.h"

#if __has_include(<version>)
#include <version>
#endif
#if defined(__cpp_lib_span)
#include <span>
#endif

namespace texere {

// The exception that a function throws if a call of the library fails.
class Error : public std::runtime_error {
public:
    // Takes message and place of the last failure of this thread.
    explicit Error(texere_status status) : std::runtime_error(texere_error_message()), status_(status) {
        texere_place place{};
        texere_error_place(&place);
        if (place.file) file_ = place.file;
        line_ = place.line, column_ = place.column;
    }

    texere_status status() const noexcept { return status_; }
    // The design's file that is at fault; empty if the error has no place.
    const std::string &file() const noexcept { return file_; }
    // The line, counted from 1; 0 if it is not known.
    std::uint64_t line() const noexcept { return line_; }
    // The column, in letters counted from 1; 0 if it is not known.
    std::uint64_t column() const noexcept { return column_; }

private:
    texere_status status_;
    std::string file_;
    std::uint64_t line_ = 0, column_ = 0;
};

// Throws an Error if a call failed.
inline void check(texere_status status) {
    if (status != TEXERE_OK) throw Error(status);
}

// Values that lie side by side in memory that another object owns, like std::span of C++20.
template <class T>
class view {
public:
    constexpr view() noexcept = default;
    constexpr view(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t Size>
    constexpr view(T (&array)[Size]) noexcept : data_(array), size_(Size) {}
    // The values of a vector, an array, a span, or any other container with `data` and `size`.
    template <class Container, class Value = std::remove_pointer_t<decltype(std::declval<Container &>().data())>,
              class = std::enable_if_t<std::is_convertible_v<Value (*)[], T (*)[]>>>
    constexpr view(Container &container) : data_(container.data()), size_(container.size()) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr T &operator[](std::size_t number) const { return data_[number]; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
#if defined(__cpp_lib_span)
    constexpr operator std::span<T>() const noexcept { return {data_, size_}; }
#endif

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

// Calls a function of texere.h, and returns the value that it writes to its last argument.
template <class Value, class Call, class... Arguments>
Value written(Call call, Arguments... arguments) {
    Value value{};
    check(call(arguments..., &value));
    return value;
}

// A handle that is freed when its owner is destroyed.
template <class Handle, void (*Free)(Handle *)>
class Owner {
public:
    // Takes over a handle.
    explicit Owner(Handle *handle) noexcept : handle_(handle) {}
    // Owns the handle that `call` makes with these other arguments.
    template <class... Parameters, class... Arguments>
    explicit Owner(texere_status (*call)(Parameters...), Arguments... arguments)
        : handle_(written<Handle *>(call, arguments...)) {}
    Owner(Owner &&other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Owner &operator=(Owner &&other) noexcept {
        if (this != &other) Free(std::exchange(handle_, std::exchange(other.handle_, nullptr)));
        return *this;
    }
    ~Owner() { Free(handle_); }

    // The handle, for calls of texere.h; null after a move.
    Handle *get() const noexcept { return handle_; }

private:
    Handle *handle_;
};

// The text of a call that writes a text. The call is made twice: for the length, and for the text.
template <class Call, class... Arguments>
std::string text(Call call, Arguments... arguments) {
    std::string words(written<std::size_t>(call, arguments..., nullptr, 0) + 1, '\0');
    words.resize(written<std::size_t>(call, arguments..., words.data(), words.size()));
    return words;
}

// A struct of texere.h with its size set.
template <class Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

// The struct that a call writes, of those calls that take a handle and a struct with its size set.
template <class Struct, class Handle>
Struct told(texere_status (*call)(const Handle *, Struct *), const Handle *handle) {
    auto value = sized<Struct>();
    check(call(handle, &value));
    return value;
}

// A function of the caller's that the library calls. If the function throws, the exception is kept
// until the call of the library has returned.
template <class Function>
class Callback {
public:
    explicit Callback(Function function) : function_(std::move(function)) {}

    // The function that the library calls, with the address of the Callback as `user`.
    template <class... Arguments>
    static std::int32_t call(void *user, Arguments... arguments) noexcept {
        auto &callback = *static_cast<Callback *>(user);
        try {
            return callback.function_(arguments...);
        } catch (...) {
            callback.thrown_ = std::current_exception();
            return 1;
        }
    }
    bool has_thrown() const noexcept { return thrown_ != nullptr; }
    // Throws the exception of the caller's function, or else an Error if the call failed.
    void check(texere_status status) const {
        if (thrown_) std::rethrow_exception(thrown_);
        texere::check(status);
    }

private:
    Function function_;
    std::exception_ptr thrown_;
};

// Makes a call that hands the bytes of a file to `take(offset, bytes)`. `call` gets the callback and
// its user. An exception of `take` ends the call and leaves this function.
template <class Take, class Call>
void hand(Take &take, Call call) {
    Callback each([&](std::uint64_t offset, const std::uint8_t *data, std::size_t size) {
        return take(offset, view<const std::uint8_t>(data, size)), 0;
    });
    each.check(call(each.call, &each));
}

// Keeps the bytes of a file in a vector: `design.write_to(TEXERE_DESIGN_FORMAT_WIF, into(bytes))`.
inline auto into(std::vector<std::uint8_t> &file) {
    return [&file](std::uint64_t offset, view<const std::uint8_t> bytes) {
        const auto first = static_cast<std::size_t>(offset);
        file.resize(std::max(file.size(), first + bytes.size()));
        std::copy(bytes.begin(), bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(first));
    };
}

// Values that lie side by side, as texere.h is given them.
template <class Value>
texere_view dense(view<Value> values) {
    return {values.data(), values.size() * sizeof(Value), sizeof(Value)};
}

// Progress and cancellation of calls. Any thread may use them.
class Run : public Owner<texere_run, texere_run_free> {
public:
    Run() : Owner(texere_run_new) {}

    void cancel() const { check(texere_run_cancel(get())); }
    // The share of the call that is done, from 0 to 1.
    double progress() const { return written<double>(texere_run_progress, get()); }
    // The handle of a run, or null if there is none.
    static const texere_run *of(const Run *run) { return run ? run->get() : nullptr; }
};

// An open device.
class Device : public Owner<texere_device, texere_device_free> {
public:
    // "auto", "cpu", "opencl:0", "wgpu" and so on.
    explicit Device(std::string_view name = "auto") : Owner(texere_device_open, name.data(), name.size()) {}

    // A description of the device, whose strings are valid as long as the device.
    texere_device_info describe() const { return told(texere_device_describe, get()); }
};

// A design that is read from a file or from memory, or made of arrays.
class Design : public Owner<texere_design, texere_design_free> {
public:
    // Reads a file: `.wif`, `.dtx`, `.wpo`, `.toml` or `.k`.
    explicit Design(std::string_view path) : Owner(texere_design_read, path.data(), path.size()) {}

    // Reads a design from memory. The ending of `name` says what kind of design it is. `files(path)`
    // is called for each file that the design names. It returns a
    // `std::optional<view<const std::uint8_t>>`, whose bytes have to stay valid until the constructor
    // returns. An exception of `files` leaves the constructor.
    Design(std::string_view name, view<const std::uint8_t> data)
        : Design(name, data, [](std::string_view) { return std::nullopt; }) {}
    template <class Files>
    Design(std::string_view name, view<const std::uint8_t> data, Files files)
        : Owner(of_memory(name, data, files)) {}

    // Makes a design of arrays, which are copied.
    explicit Design(const texere_woven &woven) : Owner(texere_design_woven, &woven) {}
    explicit Design(const texere_weft_knit &knit) : Owner(texere_design_weft_knit, &knit) {}
    explicit Design(const texere_warp_knit &knit) : Owner(texere_design_warp_knit, &knit) {}

    // Whether and how the yarns come to rest, and a design like this one with another finish.
    texere_finish finish() const { return told(texere_design_finish, get()); }
    Design finished(const texere_finish &finish) const {
        return Design(written<texere_design *>(texere_design_finished, get(), &finish));
    }
    // Writes woven cloth as a `.toml` or `.wif` file.
    void write(std::string_view path) const { check(texere_design_write(get(), path.data(), path.size())); }
    // Hands the bytes of the file to `take(offset, bytes)`. `format` is a constant whose name begins
    // with TEXERE_DESIGN_FORMAT.
    template <class Take>
    void write_to(std::uint32_t format, Take take) const {
        hand(take, [&](texere_write_callback callback, void *user) {
            return texere_design_write_to(get(), format, callback, user);
        });
    }
    // Draws the design on squared paper, from its face or its back: a `.png` file, or its bytes for
    // `take(offset, bytes)`.
    void draft(std::string_view path, bool back = false) const {
        check(texere_design_draft(get(), back, path.data(), path.size()));
    }
    template <class Take>
    void draft_to(Take take, bool back = false) const {
        hand(take, [&](texere_write_callback callback, void *user) {
            return texere_design_draft_to(get(), back, callback, user);
        });
    }

private:
    explicit Design(texere_design *made) noexcept : Owner(made) {}

    template <class Files>
    static texere_design *of_memory(std::string_view name, view<const std::uint8_t> data, Files &files) {
        Callback give([&](const char *path, std::size_t length, const std::uint8_t **bytes, std::size_t *size) {
            std::optional<view<const std::uint8_t>> file = files(std::string_view(path, length));
            if (!file) return 1;
            *bytes = file->data();
            *size = file->size();
            return 0;
        });
        texere_design *design = nullptr;
        auto status = texere_design_read_memory(name.data(), name.size(), data.data(), data.size(),
                                                give.call, &give, &design);
        if (give.has_thrown()) texere_design_free(design);
        give.check(status);
        return design;
    }
};

// Yarns: their control points, sections and materials.
class Yarns : public Owner<texere_yarns, texere_yarns_free> {
public:
    using Owner::Owner;
    // Reads a `.yarns` file.
    explicit Yarns(std::string_view path) : Owner(texere_yarns_read, path.data(), path.size()) {}
    // Makes yarns of arrays, which are copied.
    explicit Yarns(const texere_yarn_arrays &arrays) : Owner(texere_yarns_new, &arrays) {}
    // Reads the bytes of a `.yarns` file. Errors call the file `name`.
    Yarns(std::string_view name, view<const std::uint8_t> data)
        : Owner(texere_yarns_read_memory, name.data(), name.size(), data.data(), data.size()) {}

    // Reads curves that another program wrote: `.bcc`, `.obj`, `.usda` or `.tg3`. Lengths of 0 are as
    // the file says.
    static Yarns curves(std::string_view path, float unit_mm = 0, float diameter_mm = 0) {
        texere_yarns *yarns = nullptr;
        check(texere_yarns_read_curves(path.data(), path.size(), unit_mm, diameter_mm, &yarns));
        return Yarns(yarns);
    }

    // Writes a `.yarns`, `.bcc` or `.usda` file.
    void write(std::string_view path) const { check(texere_yarns_write(get(), path.data(), path.size())); }
    // Hands the bytes of the file to `take(offset, bytes)`. `format` is a constant whose name begins
    // with TEXERE_YARNS_FORMAT.
    template <class Take>
    void write_to(std::uint32_t format, Take take) const {
        hand(take, [&](texere_write_callback callback, void *user) {
            return texere_yarns_write_to(get(), format, callback, user);
        });
    }
    texere_yarn_counts counts() const { return told(texere_yarns_counts, get()); }
    // The settings that suit the yarns.
    texere_settings settings() const { return told(texere_settings_default, get()); }
    // Copies as many offsets and points as `counts` says: `yarns + 1` and `points`.
    void points(view<std::uint64_t> offsets, view<texere_point> points) const {
        check(texere_yarns_points(get(), offsets.data(), offsets.size(), points.data(), points.size()));
    }
};

// The cloth of a design.
class Cloth : public Owner<texere_cloth, texere_cloth_free> {
public:
    // Makes a cloth with its yarns at rest, if the design asks for it.
    Cloth(const Design &design, const Device &device, const Run *run = nullptr)
        : Owner(texere_cloth_rest, design.get(), device.get(), Run::of(run)) {}
    // Makes a cloth with its yarns where the structure places them.
    explicit Cloth(const Design &design) : Owner(texere_cloth_placed, design.get()) {}

    // Whether the yarns came to rest. `words` is valid as long as the cloth.
    texere_report report() const { return told(texere_cloth_report, get()); }
    // Warning `number`, counted from 0, valid as long as the cloth. `report` says how many there
    // are.
    const char *warning(std::uint64_t number) const {
        return written<const char *>(texere_cloth_warning, get(), number);
    }
    // Length of yarn, weight, thickness, crimp, cover and loops of the cloth.
    texere_measures measures() const { return told(texere_cloth_measures, get()); }
    // The length of yarn of each material, mm: as many as `measures` has materials.
    void lengths(view<double> to) const { check(texere_cloth_lengths(get(), to.data(), to.size())); }
    // What a weaver or a knitter calls the place of a hit.
    std::string place(const texere_hit &hit) const { return text(texere_cloth_place, get(), &hit); }
    Yarns yarns() const { return Yarns(texere_cloth_yarns, get()); }
};

// The plan of a mesh.
class Plan : public Owner<texere_plan, texere_plan_free> {
public:
    // Plans the mesh of yarns. Null settings stand for those that suit the yarns.
    Plan(const Yarns &yarns, const Device &device, const texere_settings *settings = nullptr)
        : Owner(texere_plan_new, yarns.get(), device.get(), settings) {}

    texere_counts counts() const { return told(texere_plan_counts, get()); }
    // The draws, which say which indices draw which yarn. They are valid as long as the plan.
    view<const texere_draw> draws() const {
        return {written<const texere_draw *>(texere_plan_draws, get()), static_cast<std::size_t>(counts().draws)};
    }
    // A chunk: where it lies in the mesh, and its draws, which are valid as long as the plan.
    texere_chunk chunk(std::uint64_t number) const {
        auto chunk = sized<texere_chunk>();
        return check(texere_plan_chunk(get(), number, &chunk)), chunk;
    }
    // For each yarn the number of its first ring, and at the end how many rings there are. The
    // numbers are valid as long as the plan.
    view<const std::uint64_t> ring_offsets() const {
        const std::uint64_t *offsets = nullptr;
        std::uint64_t count = 0;
        check(texere_plan_ring_offsets(get(), &offsets, &count));
        return {offsets, static_cast<std::size_t>(count)};
    }
    // Makes the mesh. The views have as many vertices and indices as `counts` says.
    void mesh(view<texere_vertex> vertices, view<std::uint32_t> indices, const Run *run = nullptr) const {
        check(texere_plan_mesh(get(), Run::of(run), vertices.data(), vertices.size(), indices.data(),
                               indices.size()));
    }
    // Makes the mesh in vectors, which are resized to it.
    void mesh_vectors(std::vector<texere_vertex> &vertices, std::vector<std::uint32_t> &indices,
                      const Run *run = nullptr) const {
        vertices.resize(static_cast<std::size_t>(counts().vertices));
        indices.resize(static_cast<std::size_t>(counts().indices));
        mesh(vertices, indices, run);
    }
    // Makes the mesh in arrays of positions, normals and indices that the caller describes.
    void mesh(const texere_mesh_arrays &arrays, const Run *run = nullptr) const {
        check(texere_plan_mesh_arrays(get(), Run::of(run), &arrays));
    }
    // These three make packed vertices, attributes or rings. The view has as many values as
    // `counts` has vertices or, for `trajectory`, rings.
    void packed(view<texere_packed_vertex> to, const Run *run = nullptr) const {
        fill(texere_plan_packed, to, run);
    }
    void attributes(view<texere_attribute> to, const Run *run = nullptr) const {
        fill(texere_plan_attributes, to, run);
    }
    void trajectory(view<texere_ring> to, const Run *run = nullptr) const { fill(texere_plan_trajectory, to, run); }
    // Makes the mesh piece by piece, in bounded memory, and calls `take(const texere_piece &)` for
    // each piece. An exception of `take` ends the call and leaves this function.
    template <class Take>
    void stream(Take take, const Run *run = nullptr) const {
        Callback each([&](const texere_piece *piece) { return take(*piece), 0; });
        each.check(texere_plan_stream(get(), Run::of(run), each.call, &each));
    }
    // Makes the mesh and hands the bytes of a file to `take(offset, bytes)`. `format` is a constant
    // whose name begins with TEXERE_FORMAT.
    template <class Take>
    void write_to(std::uint32_t format, Take take, const Run *run = nullptr) const {
        hand(take, [&](texere_write_callback callback, void *user) {
            return texere_plan_write_to(get(), Run::of(run), format, callback, user);
        });
    }
    // Writes the mesh to a file, `.glb`, `.ply`, `.stl` or `.obj`.
    void write(std::string_view path, const Run *run = nullptr) const {
        check(texere_plan_write(get(), Run::of(run), path.data(), path.size()));
    }

private:
    template <class Call, class Value>
    void fill(Call call, view<Value> to, const Run *run) const {
        const texere_view values = dense(to);
        check(call(get(), Run::of(run), &values));
    }
};

// The mesh of a plan, made on its device chunk by chunk and left there, for a program that draws with
// OpenCL or Vulkan. Buffers are valid as long as the session. One thread at a time may use it.
class Session : public Owner<texere_session, texere_session_free> {
public:
    explicit Session(const Plan &plan, const Run *run = nullptr)
        : Owner(texere_session_new, plan.get(), Run::of(run)) {}

    // The objects of OpenCL or Vulkan that the session works with.
    texere_native native() const { return told(texere_session_native, get()); }
    // Makes a chunk on the device, and lends its buffers until two other chunks have been made. The
    // device may still be at work on it.
    texere_device_mesh mesh(std::uint64_t chunk) {
        auto mesh = sized<texere_device_mesh>();
        return check(texere_session_mesh(get(), chunk, &mesh)), mesh;
    }
    // Waits until the device has done all that was asked of it.
    void wait() { check(texere_session_wait(get())); }
    // Reads a chunk that was made. The views have as many vertices and indices as it.
    void read(std::uint64_t chunk, view<texere_vertex> vertices, view<std::uint32_t> indices) const {
        check(texere_session_read(get(), chunk, vertices.data(), vertices.size(), indices.data(), indices.size()));
    }
};

// The check of a cloth: its faults and their cures. All its strings are valid as long as the check.
class Check : public Owner<texere_check, texere_check_free> {
public:
    explicit Check(const Cloth &cloth, const texere_settings *settings = nullptr, const Run *run = nullptr)
        : Owner(texere_check_new, cloth.get(), settings, TEXERE_ACCURACY, Run::of(run)) {}

    texere_diagnosis diagnosis() const { return told(texere_check_diagnosis, get()); }
    // The fault and the warning of a number, counted from 0; `diagnosis` says how many there are.
    texere_fault fault(std::uint64_t number) const {
        auto fault = sized<texere_fault>();
        return check(texere_check_fault(get(), number, &fault)), fault;
    }
    const char *warning(std::uint64_t number) const {
        return written<const char *>(texere_check_warning, get(), number);
    }
    // The faults and their cures as JSON, and in `measures_json` the counts and measures of the
    // cloth.
    const char *json() const { return written<const char *>(texere_check_json, get()); }
    const char *measures_json() const { return written<const char *>(texere_check_measures_json, get()); }
};

// Says what a ray hits first of the mesh of yarns. `found` of the hit is 0 if the ray hits nothing.
class Picker : public Owner<texere_picker, texere_picker_free> {
public:
    explicit Picker(const Yarns &yarns, const texere_settings *settings = nullptr)
        : Owner(texere_picker_new, yarns.get(), settings) {}
    texere_hit pick(const texere_ray &ray) const { return written<texere_hit>(texere_picker_pick, get(), &ray); }
};

// A cloth that is being edited, with its mesh on a device. One thread at a time may use it.
class Live : public Owner<texere_live, texere_live_free> {
public:
    Live(const Cloth &cloth, const Device &device, const texere_settings *settings = nullptr)
        : Owner(texere_live_of_cloth, cloth.get(), device.get(), settings) {}
    // Of yarns, which have no weave: lifts can't be set.
    Live(const Yarns &yarns, const Device &device, const texere_settings *settings = nullptr)
        : Owner(texere_live_of_yarns, yarns.get(), device.get(), settings) {}

    // Whether the warp is up where an end and a pick cross. Ends and picks count from 0.
    bool lift(std::uint64_t end, std::uint64_t pick) const {
        return written<std::uint32_t>(texere_live_lift, get(), end, pick) != 0;
    }
    void set_lift(std::uint64_t end, std::uint64_t pick, bool up) {
        check(texere_live_set_lift(get(), end, pick, up));
    }
    // Sets the lifts where `ends` ends from `first_end` on cross the picks from `first_pick` on. `up`
    // has a byte for each of these crossings, 1 if the warp is up, else 0: pick after pick, and those
    // of a pick in the order of the ends.
    void set_drawdown(std::uint64_t first_end, std::uint64_t ends, std::uint64_t first_pick,
                      view<const std::uint8_t> up) {
        const std::uint64_t picks = ends ? up.size() / ends : 0;
        if (picks * ends != up.size()) throw std::invalid_argument("up has no whole number of picks");
        check(texere_live_set_drawdown(get(), first_end, ends, first_pick, picks, up.data()));
    }
    // Properties of a yarn, and its control points. Yarns count from 0.
    texere_yarn yarn(std::uint64_t yarn) const {
        auto what = sized<texere_yarn>();
        return check(texere_live_yarn(get(), yarn, &what)), what;
    }
    void set_yarn(std::uint64_t yarn, const texere_yarn &what, view<const texere_point> points) {
        check(texere_live_set_yarn(get(), yarn, &what, points.data(), points.size()));
    }
    void set_points(std::uint64_t yarn, view<const texere_point> points) {
        check(texere_live_set_points(get(), yarn, points.data(), points.size()));
    }
    // A material, counted from 0. Its name is valid until the next call of `material`.
    texere_material material(std::uint64_t number) const {
        return written<texere_material>(texere_live_material, get(), number);
    }
    void set_material(std::uint64_t number, const texere_material &material) {
        check(texere_live_set_material(get(), number, &material));
    }
    // Sets the tension of the splines of all yarns, from 0 to below 1.
    void set_tension(float tension) { check(texere_live_set_tension(get(), tension)); }
    // Replaces the structure, or all yarns, or all yarns by those of the same cloth at rest.
    void set_structure(const Design &design) { check(texere_live_set_structure(get(), design.get())); }
    void set_yarns(const Yarns &yarns) { check(texere_live_set_yarns(get(), yarns.get())); }
    void set_rest(const Yarns &yarns) { check(texere_live_set_rest(get(), yarns.get())); }
    // Brings the edits to the mesh. The changes are valid until the next update.
    texere_update update(const Run *run = nullptr) {
        auto update = sized<texere_update>();
        return check(texere_live_update(get(), Run::of(run), &update)), update;
    }
    texere_counts counts() const { return told(texere_live_counts, get()); }
    // The draws, which say which indices draw which yarn. They are valid until the next update.
    view<const texere_draw> draws() const {
        return {written<const texere_draw *>(texere_live_draws, get()), static_cast<std::size_t>(counts().draws)};
    }
    // Reads the mesh, or a change of it. The views have as many vertices and indices as `counts` or
    // the change says.
    void mesh(view<texere_vertex> vertices, view<std::uint32_t> indices, const Run *run = nullptr) const {
        check(texere_live_mesh(get(), Run::of(run), vertices.data(), vertices.size(), indices.data(),
                               indices.size()));
    }
    void read(const texere_change &change, view<texere_vertex> vertices, view<std::uint32_t> indices) const {
        check(texere_live_read(get(), &change, vertices.data(), vertices.size(), indices.data(), indices.size()));
    }
    // Makes attributes as well as the mesh, from the next update on, which makes the whole mesh again.
    void keep_attributes() { check(texere_live_keep_attributes(get())); }
    // Reads the attributes, as many as vertices: all, or those of a change.
    void attributes(view<texere_attribute> to, const Run *run = nullptr) const {
        const texere_view values = dense(to);
        check(texere_live_attributes(get(), Run::of(run), &values));
    }
    void read_attributes(const texere_change &change, view<texere_attribute> to) const {
        const texere_view values = dense(to);
        check(texere_live_read_attributes(get(), &change, &values));
    }
    // The yarns, and what a ray hits, as they are now. Edits count even before an update.
    Yarns yarns() const { return Yarns(texere_live_yarns, get()); }
    texere_hit pick(const texere_ray &ray) const { return written<texere_hit>(texere_live_pick, get(), &ray); }
    std::string place(const texere_hit &hit) const { return text(texere_live_place, get(), &hit); }
};

// A device that makes pictures, and the yarns that the pictures show. One thread at a time may use
// it.
class Renderer : public Owner<texere_renderer, texere_renderer_free> {
public:
    // "auto", "wgpu", "wgpu:1" and so on.
    explicit Renderer(std::string_view name = "auto") : Owner(texere_renderer_open, name.data(), name.size()) {}

    // The usual picture.
    static texere_picture usual() {
        auto picture = sized<texere_picture>();
        return check(texere_picture_default(&picture)), picture;
    }
    // Shows yarns from now on in place of those before.
    void show(const Yarns &yarns, const texere_settings *settings = nullptr, const Run *run = nullptr) {
        check(texere_renderer_show(get(), yarns.get(), settings, Run::of(run)));
    }
    // The box round the yarns that it shows.
    texere_extent extent() const { return written<texere_extent>(texere_renderer_extent, get()); }
    // What the last picture shows at a point, in pixels from its left and upper edges.
    texere_seen seen(float x, float y) const { return written<texere_seen>(texere_renderer_seen, get(), x, y); }
    // Makes a picture: four bytes for each pixel, in rows from the top that lie side by side.
    void picture(const texere_picture &picture, view<std::uint8_t> pixels, const Run *run = nullptr) const {
        const texere_view rows{pixels.data(), pixels.size(), std::uint64_t{4} * picture.width};
        check(texere_renderer_picture(get(), &picture, Run::of(run), &rows));
    }
    // Makes a picture as a `.png` file, or hands the bytes of the file to `take(offset, bytes)`.
    void write(const texere_picture &picture, std::string_view path, const Run *run = nullptr) const {
        check(texere_renderer_write(get(), &picture, Run::of(run), path.data(), path.size()));
    }
    template <class Take>
    void write_to(const texere_picture &picture, Take take, const Run *run = nullptr) const {
        hand(take, [&](texere_write_callback callback, void *user) {
            return texere_renderer_write_to(get(), &picture, Run::of(run), callback, user);
        });
    }
};

}  // namespace texere

#endif  // TEXERE_HPP
