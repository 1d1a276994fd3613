// texere for C++17: classes over texere.h that free what they hold, and exceptions.
//
// A class that is made of a handle owns it: it can be moved and not copied. A function that fails
// throws texere::Error. The functions of a class do what those of texere.h that they call do, and
// texere.h says what that is: units, threads, how long lent memory is valid.
//
// Nothing is allocated behind the caller's back: meshes and points go to memory of the caller's, or
// to vectors where the name of the function says so. What has no function here is a call of texere.h
// with `get()` of the handle, in `texere::check`.

#ifndef TEXERE_HPP
#define TEXERE_HPP

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

// What a function throws where a call of the library fails.
class Error : public std::runtime_error {
public:
    // The last failure of this thread.
    explicit Error(texere_status status) : std::runtime_error(texere_error_message()), status_(status) {
        texere_place place{};
        if (texere_error_place(&place) == TEXERE_OK && place.file) {
            file_ = place.file;
            line_ = place.line;
            column_ = place.column;
        }
    }

    texere_status status() const noexcept { return status_; }
    // The design's file that is at fault; empty where the error has no place.
    const std::string &file() const noexcept { return file_; }
    // The line, from 1; 0 where it is not known.
    std::uint64_t line() const noexcept { return line_; }
    // The column, in letters from 1; 0 where it is not known.
    std::uint64_t column() const noexcept { return column_; }

private:
    texere_status status_;
    std::string file_;
    std::uint64_t line_ = 0, column_ = 0;
};

// Throws what went wrong in a call.
inline void check(texere_status status) {
    if (status != TEXERE_OK) throw Error(status);
}

// Values that lie side by side in memory of someone else's, as std::span of C++20.
template <class T>
class view {
public:
    using value_type = std::remove_cv_t<T>;
    using iterator = T *;

    constexpr view() noexcept = default;
    constexpr view(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t Size>
    constexpr view(T (&array)[Size]) noexcept : data_(array), size_(Size) {}
    // Of a vector, an array, a span: whatever has `data` and `size`.
    template <class Container, class = std::enable_if_t<std::is_convertible_v<
                                   std::remove_pointer_t<decltype(std::declval<Container &>().data())> (*)[],
                                   T (*)[]>>>
    constexpr view(Container &container) : data_(container.data()), size_(container.size()) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T &operator[](std::size_t number) const { return data_[number]; }
    constexpr iterator begin() const noexcept { return data_; }
    constexpr iterator end() const noexcept { return data_ + size_; }
#if defined(__cpp_lib_span)
    constexpr operator std::span<T>() const noexcept { return {data_, size_}; }
#endif

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

// All of a view's values, as a view of texere.h.
template <class T>
texere_view strided(view<T> values) {
    return {const_cast<std::remove_const_t<T> *>(values.data()), values.size() * sizeof(T), sizeof(T)};
}

// A handle that is freed when its owner goes.
template <class Handle, void (*Free)(Handle *)>
class Owner {
public:
    // Takes a handle over.
    explicit Owner(Handle *handle) noexcept : handle_(handle) {}
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

// The handle that a call makes, which it writes to its last argument.
template <class Handle, class Call, class... Arguments>
Handle *made(Call call, Arguments... arguments) {
    Handle *handle = nullptr;
    check(call(arguments..., &handle));
    return handle;
}

// A struct of texere.h with its size set.
template <class Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

// The struct that a call writes about a handle.
template <class Struct, class Handle>
Struct told(texere_status (*call)(const Handle *, Struct *), const Handle *handle) {
    auto value = sized<Struct>();
    check(call(handle, &value));
    return value;
}

// A function of the caller's that the library calls. What it throws is kept until the call is over.
template <class Function>
class Callback {
public:
    explicit Callback(Function function) : function_(std::move(function)) {}

    // What the library calls, with the callback as `user`.
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
    // Throws what the function has thrown, or else what went wrong in the call.
    void check(texere_status status) const {
        if (thrown_) std::rethrow_exception(thrown_);
        texere::check(status);
    }

private:
    Function function_;
    std::exception_ptr thrown_;
};

// Progress of calls, and their end before they are done. Any thread may ask and cancel.
class Run : public Owner<texere_run, texere_run_free> {
public:
    Run() : Owner(made<texere_run>(texere_run_new)) {}

    void cancel() const { check(texere_run_cancel(get())); }
    // How much of the call is done, from 0 to 1.
    double progress() const {
        double share = 0;
        check(texere_run_progress(get(), &share));
        return share;
    }
    // The handle of a run that may be left out.
    static const texere_run *of(const Run *run) { return run ? run->get() : nullptr; }
};

// An open device.
class Device : public Owner<texere_device, texere_device_free> {
public:
    // "auto", "cpu", "opencl:0", "wgpu" and so on.
    explicit Device(std::string_view name = "auto")
        : Owner(made<texere_device>(texere_device_open, name.data(), name.size())) {}

    // What it is. The strings are valid as long as the device.
    texere_device_info describe() const { return told(texere_device_describe, get()); }
};

// A design that was read.
class Design : public Owner<texere_design, texere_design_free> {
public:
    // Of a file: `.wif`, `.toml`, `.k`.
    explicit Design(std::string_view path)
        : Owner(made<texere_design>(texere_design_read, path.data(), path.size())) {}

    // Of memory. The ending of `name` says what kind of design it is.
    Design(std::string_view name, view<const std::uint8_t> data)
        : Design(name, data, [](std::string_view) { return std::nullopt; }) {}

    // Of memory, with files that the design names: `files(path)` gives
    // `std::optional<view<const std::uint8_t>>`, whose bytes stay valid until this returns. What it
    // throws is thrown on.
    template <class Files>
    Design(std::string_view name, view<const std::uint8_t> data, Files files)
        : Owner(of_memory(name, data, files)) {}

private:
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
    // Of a `.yarns` file.
    explicit Yarns(std::string_view path)
        : Owner(made<texere_yarns>(texere_yarns_read, path.data(), path.size())) {}
    // Of arrays, which are copied.
    explicit Yarns(const texere_yarn_arrays &arrays)
        : Owner(made<texere_yarns>(texere_yarns_new, &arrays)) {}

    void write(std::string_view path) const { check(texere_yarns_write(get(), path.data(), path.size())); }
    texere_yarn_counts counts() const { return told(texere_yarns_counts, get()); }
    // The settings that suit them.
    texere_settings settings() const { return told(texere_settings_default, get()); }
    // Copies as many offsets and points as `counts` says: `yarns + 1` and `points`.
    void points(view<std::uint64_t> offsets, view<texere_point> points) const {
        check(texere_yarns_points(get(), offsets.data(), offsets.size(), points.data(), points.size()));
    }
};

// The cloth of a design.
class Cloth : public Owner<texere_cloth, texere_cloth_free> {
public:
    // With its yarns at rest, where the design asks for it.
    Cloth(const Design &design, const Device &device, const Run *run = nullptr)
        : Owner(made<texere_cloth>(texere_cloth_rest, design.get(), device.get(), Run::of(run))) {}
    // With its yarns as the structure places them.
    explicit Cloth(const Design &design) : Owner(made<texere_cloth>(texere_cloth_placed, design.get())) {}

    // How the yarns came to rest. `words` is valid as long as the cloth.
    texere_report report() const { return told(texere_cloth_report, get()); }
    // The warning of a number, from 0, valid as long as the cloth; `report` says how many there are.
    const char *warning(std::uint64_t number) const {
        const char *words = nullptr;
        check(texere_cloth_warning(get(), number, &words));
        return words;
    }
    Yarns yarns() const { return Yarns(made<texere_yarns>(texere_cloth_yarns, get())); }
};

// The plan of a mesh.
class Plan : public Owner<texere_plan, texere_plan_free> {
public:
    // With the settings that suit the yarns, unless others are given.
    Plan(const Yarns &yarns, const Device &device, const texere_settings *settings = nullptr)
        : Owner(made<texere_plan>(texere_plan_new, yarns.get(), device.get(), settings)) {}

    texere_counts counts() const { return told(texere_plan_counts, get()); }
    // Which indices draw which yarn, valid as long as the plan.
    view<const texere_draw> draws() const {
        const texere_draw *draws = nullptr;
        check(texere_plan_draws(get(), &draws));
        return {draws, static_cast<std::size_t>(counts().draws)};
    }
    // Makes the mesh: as many vertices and indices as `counts` says.
    void mesh(view<texere_vertex> vertices, view<std::uint32_t> indices, const Run *run = nullptr) const {
        check(texere_plan_mesh(get(), Run::of(run), vertices.data(), vertices.size(), indices.data(),
                               indices.size()));
    }
    // Makes the mesh in vectors, which get the size that they need.
    void mesh_vectors(std::vector<texere_vertex> &vertices, std::vector<std::uint32_t> &indices,
                      const Run *run = nullptr) const {
        vertices.resize(static_cast<std::size_t>(counts().vertices));
        indices.resize(static_cast<std::size_t>(counts().indices));
        mesh(vertices, indices, run);
    }
    // Makes the mesh in arrays of positions, normals and indices, wherever they lie.
    void mesh(const texere_mesh_arrays &arrays, const Run *run = nullptr) const {
        check(texere_plan_mesh_arrays(get(), Run::of(run), &arrays));
    }
    // Makes packed vertices or attributes, as many as vertices, or a ring for each ring.
    void packed(view<texere_packed_vertex> packed, const Run *run = nullptr) const {
        auto to = strided(packed);
        check(texere_plan_packed(get(), Run::of(run), &to));
    }
    void attributes(view<texere_attribute> attributes, const Run *run = nullptr) const {
        auto to = strided(attributes);
        check(texere_plan_attributes(get(), Run::of(run), &to));
    }
    void trajectory(view<texere_ring> rings, const Run *run = nullptr) const {
        auto to = strided(rings);
        check(texere_plan_trajectory(get(), Run::of(run), &to));
    }
    // Makes the mesh piece by piece, in bounded memory: `take(const texere_piece &)` gets each. What
    // it throws ends the call, and is thrown on.
    template <class Take>
    void stream(Take take, const Run *run = nullptr) const {
        Callback each([&](const texere_piece *piece) { return take(*piece), 0; });
        each.check(texere_plan_stream(get(), Run::of(run), each.call, &each));
    }
    // Writes a file of the format that begins with TEXERE_FORMAT to `take(offset, bytes)`.
    template <class Take>
    void write_to(std::uint32_t format, Take take, const Run *run = nullptr) const {
        Callback each([&](std::uint64_t offset, const std::uint8_t *data, std::size_t size) {
            return take(offset, view<const std::uint8_t>(data, size)), 0;
        });
        each.check(texere_plan_write_to(get(), Run::of(run), format, each.call, &each));
    }
    // Writes the mesh to a file, `.glb` or `.ply`.
    void write(std::string_view path, const Run *run = nullptr) const {
        check(texere_plan_write(get(), Run::of(run), path.data(), path.size()));
    }
};

}  // namespace texere

#endif  // TEXERE_HPP
