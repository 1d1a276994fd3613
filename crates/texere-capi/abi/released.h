// texere: textile designs to yarn-level 3D geometry.
//
// A function that can fail returns a texere_status; texere_error_message says in words what went
// wrong, and texere_error_place where in a design's file. A handle is a number with the type of a
// pointer. The library looks it up in a table and never dereferences it, so a handle that was freed
// is refused. A `_free` function does nothing for a null handle, and for one that was freed already.
//
// Handles may be used by several threads at once, unless their description says that one thread at a
// time may use them. A handle that is freed while another thread's call uses it lives until that call
// ends.
//
// Strings are UTF-8 with a length in bytes. Lengths are in mm, angles in radians; x runs along the
// weft or the courses, y along the warp or the wales, z out of the technical face.
//
// Made by cbindgen from crates/texere-capi: do not edit.


#ifndef TEXERE_H
#define TEXERE_H

#include <stddef.h>
#include <stdint.h>

// The number of the binary interface. A program compares this number of its header with what
// `texere_abi` of the loaded library returns. If the two differ, the program can't use that
// library.
#define TEXERE_ABI 1

// The usual `accuracy` of `texere_check_new`: the share by which yarns may come short of touching
// and still count as touching.
#define TEXERE_ACCURACY 0.015

// At a place there is more yarn than room, or so many parts of yarns that they can't be measured
// pair by pair. The value is the volume of the yarns over the room.
#define TEXERE_FAULT_CROWDED 0

// Two yarns pierce one another. The value is how near they come: 1 if they just touch, less if
// they pierce.
#define TEXERE_FAULT_PIERCES 1

// A bend is so tight that the tube folds into itself. The value is the radius of the bend over how
// far the yarn's section reaches into the bend; below 1 the tube folds.
#define TEXERE_FAULT_FOLDS 2

// A thread lies so close to the thread before it that crossing threads can't pass between the two.
// The value is their distance over the distance that is needed. The fault has no single place.
#define TEXERE_FAULT_JAMS 3

// The cloth does not hang together. The value is the number of its pieces. The fault has no single
// place.
#define TEXERE_FAULT_APART 4

// The mesh is wrung: narrowed because two neighbouring rings are turned against one another. The
// value is the width half way between the two, as a share of the width on the rings.
#define TEXERE_FAULT_WRUNG 5

// Triangles of the mesh face inwards. The value is how many; the place is that of the first
// triangle.
#define TEXERE_FAULT_INSIDE_OUT 6

// A knitting machine can't do a step of the program. There is neither a value nor a place.
#define TEXERE_FAULT_MACHINE 7

// The yarns are where the structure places them, because the design does not ask that they come to
// rest, or because `texere_cloth_placed` made the cloth.
#define TEXERE_PLACED 0

// The yarns came to rest.
#define TEXERE_AT_REST 1

// The yarns settled without coming to rest. `words` of the report is "not at rest", or "jammed,
// not at rest" if the yarns of a knit have no room.
#define TEXERE_NOT_AT_REST 2

// The yarns are where the structure places them, because they can't come to rest. `words` of the
// report says why.
#define TEXERE_REFUSED 3

// The form of texere's own design file, `.toml`.
#define TEXERE_DESIGN_FORMAT_TOML 0

// The form of a WIF 1.1 draft, `.wif`.
#define TEXERE_DESIGN_FORMAT_WIF 1

// The form of a knitout file, `.k`.
#define TEXERE_DESIGN_FORMAT_KNITOUT 2

// The structure's own choice. A weft knit gets the loop lengths of its program or its gauge; if it
// has neither, its lengths are free. A warp knit gets the lengths of its run-ins; if a bar with
// yarns has none, yarns keep their lengths.
#define TEXERE_LENGTH_USUAL 0

// Yarns keep their lengths, interval by interval, so that no yarn is drawn along its path.
#define TEXERE_LENGTH_HELD 1

// Yarns get `length` times the length that they have at the start, 0.5 to 2.
#define TEXERE_LENGTH_GIVEN 2

// Yarns take the length that their path needs. `length` is a tension that shortens them, 0 to 0.1:
// the share of its length by which an interval is shortened in a pass.
#define TEXERE_LENGTH_FREE 3

// Cloth is not stretched.
#define TEXERE_STRETCH_NONE 0

// Woven cloth is stretched along its warp.
#define TEXERE_STRETCH_WARP 1

// Woven cloth is stretched along its weft.
#define TEXERE_STRETCH_WEFT 2

// Buffers are `cl_mem`.
#define TEXERE_NATIVE_OPENCL 1

// Buffers are `VkBuffer`.
#define TEXERE_NATIVE_VULKAN 2

// A circle.
#define TEXERE_SECTION_CIRCLE 0

// An ellipse whose width over height is `aspect`.
#define TEXERE_SECTION_ELLIPSE 1

// Two arcs that meet in two edges. The section has `aspect`; `form` is the height of the edges
// above the middle, in half heights, -0.9 to 0.9.
#define TEXERE_SECTION_LENTICULAR 2

// An ellipse whose height at angle a is in proportion to |sin a|^`form` instead of |sin a|. The
// section has `aspect`; `form` is 0.1 to 4, and 1 is an ellipse.
#define TEXERE_SECTION_POWER_ELLIPSE 3

// The outline of `count` plies twisted together, 2 to 12. `form` is the distance of the valley
// between two plies from the axis, as a share of the distance to which a ply reaches: 0.5 to 1, or
// 0 for plies that nothing presses.
#define TEXERE_SECTION_LOBED 4

// The outline through `corners`: `count` corners, 3 to 256.
#define TEXERE_SECTION_POLYGON 5

// No cap: the hit is on the side of the yarn.
#define TEXERE_CAP_NONE 0

// The cap that closes the start of the yarn.
#define TEXERE_CAP_START 1

// The cap that closes the end of the yarn.
#define TEXERE_CAP_FINISH 2

// The whole cloth from straight above its face.
#define TEXERE_VIEW_FACE 0

// The whole cloth from above, with the eye on the side of the cloth's lower edge. `turn` turns the
// eye about the cloth's middle.
#define TEXERE_VIEW_OBLIQUE 1

// A part of the cloth, `width_mm` wide, round the point `at`, from above and aside.
#define TEXERE_VIEW_CLOSE_UP 2

// A cut across the ends, through the point `at`. The picture shows `width_mm` of it.
#define TEXERE_VIEW_CUT_WARP 3

// A cut across the picks, through the point `at`. The picture shows `width_mm` of it.
#define TEXERE_VIEW_CUT_WEFT 4

// The view from `eye` to `target`, with `field_of_view`.
#define TEXERE_VIEW_EYE 5

// The view in the direction from `eye` to `target`, with parallel lines of sight. The picture
// shows `height_mm` from its lower to its upper edge.
#define TEXERE_VIEW_PARALLEL 6

// Light grey ground that the cloth lies on and casts its shadow on.
#define TEXERE_BACKGROUND_GROUND 0

// One colour, `color`.
#define TEXERE_BACKGROUND_COLOR 1

// Nothing. Alpha says how much of each pixel shows yarn.
#define TEXERE_BACKGROUND_NOTHING 2

// Sections stand upright: their width lies at right angles to z. A round yarn that runs too
// steeply for that at any place has TEXERE_FRAME_ROTATION_MINIMIZING instead, along all its
// length. A flattened yarn that runs so steeply leans instead: see `lean` of `texere_ring`.
#define TEXERE_FRAME_UPRIGHT 0

// Sections are carried along the yarn without turning about it.
#define TEXERE_FRAME_ROTATION_MINIMIZING 1

// Three indices for each triangle, counted from the base vertex of their draw.
#define TEXERE_TOPOLOGY_INDEXED 0

// One pattern of indices that all draws use, counted from the base vertex of each draw.
#define TEXERE_TOPOLOGY_SHARED 1

// No indices.
#define TEXERE_TOPOLOGY_NONE 2

// Each stitch has as many control points as the bends of its yarn need.
#define TEXERE_CELLS_ROUND 0

// All stitches have the same number of control points.
#define TEXERE_CELLS_EVEN 1

// The number that stands for no yarn in `threading` of a bar.
#define TEXERE_NO_YARN 4294967295

// The front needle knits.
#define TEXERE_STITCH_KNIT 0

// The back needle knits.
#define TEXERE_STITCH_PURL 1

// Front and back needle both knit. This needs two beds.
#define TEXERE_STITCH_BOTH 2

// The needle takes the yarn and keeps its loops. On two beds it is the front needle.
#define TEXERE_STITCH_TUCK 3

// The back needle takes the yarn and keeps its loops. This needs two beds.
#define TEXERE_STITCH_BACK_TUCK 4

// The yarn floats past.
#define TEXERE_STITCH_MISS 5

// The front needle knits, and its loop then moves by `moved` needles, in front of other loops that
// move.
#define TEXERE_STITCH_MOVED 6

// The front needle knits, and its loop then moves by `moved` needles, behind other loops that
// move.
#define TEXERE_STITCH_MOVED_BEHIND 7

// The back of a Jacquard shows floats: only the front needles knit.
#define TEXERE_BACKING_NONE 0

// Every other back needle knits, alternating from yarn to yarn and from row to row.
#define TEXERE_BACKING_BIRDSEYE 1

// Each of the n yarns of a row knits on every n-th back needle, and on the same needles in all
// rows that have the same yarns.
#define TEXERE_BACKING_LADDER 2

// Threads bend round one another as round threads do, and floats lie flat.
#define TEXERE_SHAPE_ROUND 0

// A thread has one control point at each crossing, one before all of them and one after.
#define TEXERE_SHAPE_CROSSING 1

// Threads that lie too close are only reported.
#define TEXERE_RELIEF_REPORT 0

// Threads that lie too close are flattened.
#define TEXERE_RELIEF_FLATTEN 1

// Threads that lie too close are made thinner.
#define TEXERE_RELIEF_SHRINK 2

// Warp and weft share the crimp by stiffness, which is taken as the fourth power of the radius:
// the stiffer set stays straighter. `stiffness` of the threads does not count.
#define TEXERE_CRIMP_STIFFNESS 0

// The warp has `warp_share` of the crimp.
#define TEXERE_CRIMP_SHARE 1

// glTF 2.0 in one binary file, `.glb`.
#define TEXERE_FORMAT_GLB 0

// Binary PLY, `.ply`.
#define TEXERE_FORMAT_PLY 1

// Binary STL, `.stl`: triangles without colours.
#define TEXERE_FORMAT_STL 2

// OBJ, `.obj`. Its materials are in a file beside it whose name ends in `.mtl`. A callback gets
// the bytes of the `.obj` file alone, which names `materials.mtl`.
#define TEXERE_FORMAT_OBJ 3

// glTF 2.0 in one binary file, with 12 bytes for a vertex instead of 24: whole numbers, as the
// extension KHR_mesh_quantization allows. The largest side of the box that a yarn lies in has
// 65,534 steps. Coordinates are off by half a step at most, and normals by 0.4 degrees. The mesh
// is made twice. A yarn whose box has a side of more than 655 mm is refused with
// TEXERE_UNSUPPORTED.
#define TEXERE_FORMAT_PACKED_GLB 4

// A packed glTF file that is compressed to about half of its bytes, as the extension
// EXT_meshopt_compression says.
#define TEXERE_FORMAT_COMPRESSED_GLB 5

// glTF 2.0 in one binary file that holds each part of a yarn once, however often it recurs, as the
// extension EXT_mesh_gpu_instancing says. The mesh is made twice. Cloth whose different parts take
// more than 256 MiB is refused with TEXERE_UNSUPPORTED.
#define TEXERE_FORMAT_INSTANCED_GLB 6

// The text form of Universal Scene Description, `.usda`: a mesh for each yarn.
#define TEXERE_FORMAT_USDA 7

// A packed glTF file that is compressed further than TEXERE_FORMAT_COMPRESSED_GLB, as the later
// extension KHR_meshopt_compression says. Fewer programs know it.
#define TEXERE_FORMAT_KHR_COMPRESSED_GLB 8

// texere's own form of yarns, `.yarns`.
#define TEXERE_YARNS_FORMAT_YARNS 0

// Binary Curve Collection, `.bcc`: control points alone.
#define TEXERE_YARNS_FORMAT_BCC 1

// The text form of Universal Scene Description, `.usda`: curves with diameters and colours.
#define TEXERE_YARNS_FORMAT_USDA 2

// The text form of Universal Scene Description with straight lines between control points, for
// simulators. It has thicknesses and masses as the Alliance for OpenUSD proposes them.
#define TEXERE_YARNS_FORMAT_LINEAR_USDA 3

// How a call ended.
typedef enum texere_status {
  // The call did what it is for.
  TEXERE_OK = 0,
  // An argument is refused: a null or misaligned pointer, a wrong size, a value out of its
  // range, or a handle that was freed, is of another kind, is in use by another thread or is not
  // ready for the call.
  TEXERE_ARGUMENT = 1,
  // A file holds no design or no yarns, or the cloth of a design can't be made.
  TEXERE_DESIGN = 2,
  // There is no such device, or it failed.
  TEXERE_DEVICE = 3,
  // Memory did not suffice, on the host or on the device.
  TEXERE_MEMORY = 4,
  // A file can't be read or written.
  TEXERE_IO = 5,
  // The call ended early, because `texere_run_cancel` was called, or because a callback that
  // takes pieces of a mesh or of a file returned a number other than 0.
  TEXERE_CANCELLED = 6,
  // The library was built without what the call needs, or the device or the file format does not
  // support it.
  TEXERE_UNSUPPORTED = 7,
  // The library itself has a fault: its code panicked. The panic was caught, and the library can
  // still be used.
  TEXERE_PANIC = 8,
} texere_status;

// The check of a cloth: how near its yarns come to one another, its faults, and their cures.
typedef struct texere_check texere_check;

// The cloth of a design: its yarns, and whether they came to rest.
typedef struct texere_cloth texere_cloth;

// A design: read from a WIF draft, a design file or a program of a knitting machine, or made from
// the caller's arrays.
typedef struct texere_design texere_design;

// An open device: a GPU, or the CPU.
typedef struct texere_device texere_device;

// A cloth that is being edited, with its whole mesh on a device. One thread at a time may use it:
// a call fails with TEXERE_ARGUMENT while a call of another thread is using it.
//
// `texere_live_yarns` and `texere_live_pick` see an edit at once. `texere_live_update` brings
// edits to the mesh. To undo an edit, set the old value again.
typedef struct texere_live texere_live;

// A picker, which says what a ray would hit first of the mesh of yarns. The mesh itself is not
// made.
typedef struct texere_picker texere_picker;

// The plan of a mesh: yarns, settings and a device. It has all sizes of the mesh before the mesh
// is made.
//
// A mesh is made in chunks, which are so small that a call ends within 50 ms after its run is
// cancelled. How many there are depends on the device, and on the number of the machine's cores.
// If a chunk ends inside a yarn, its last ring is also the first ring of the next chunk.
typedef struct texere_plan texere_plan;

// A device that makes pictures, and the yarns that the pictures show. One thread at a time may use
// it: a call fails with TEXERE_ARGUMENT while a call of another thread is using it.
typedef struct texere_renderer texere_renderer;

// The progress of a call that takes long, and whether the call is to end. Other threads read the
// progress, and cancel the run. A run may be given to one call after another; the progress begins
// at 0 in each.
typedef struct texere_run texere_run;

// A session, which makes the mesh of a plan on the plan's device, chunk by chunk, and leaves the
// chunks there. The device holds two chunks at a time: a third one that `texere_session_mesh`
// makes takes the buffers of the older one.
//
// One thread at a time may use a session: a call fails with TEXERE_ARGUMENT while a call of
// another thread is using it.
typedef struct texere_session texere_session;

// Yarns: their control points, sections and materials.
typedef struct texere_yarns texere_yarns;

// The settings of a mesh. `texere_settings_default` fills it in.
typedef struct texere_settings {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // How many points are inserted between two control points, 0 to 1023.
  uint32_t subdivisions;
  // How many sides the tubes have, 3 to 256.
  uint32_t sides;
  // A constant whose name begins with TEXERE_FRAME.
  uint32_t frame;
  // A constant whose name begins with TEXERE_TOPOLOGY.
  uint32_t topology;
  // 1 if the ends of yarns are closed, else 0.
  uint32_t caps;
  // The step of the grid that packed positions lie on, mm: a power of two from 2^-24 to 2^11.
  float quantum_mm;
} texere_settings;

// The result of a check.
typedef struct texere_diagnosis {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // 1 if there is no fault, else 0.
  uint32_t clean;
  // "clean", or the faults in one phrase, such as "pierces itself, folds": UTF-8 that ends with
  // a zero byte, valid until the check is freed.
  const char *words;
  // The clearance below which two yarns count as piercing one another.
  double touching;
  // The least clearance, which says how near yarns come to one another: 1 if they just touch,
  // less if they pierce. Infinite if no yarns come near one another; NaN if all places where
  // they do are too crowded to be measured.
  double clearance;
  // How many contacts there are: places where two yarns come near one another.
  uint64_t contacts;
  // How many contacts have a clearance below 1 by more than 0.001.
  uint64_t below_one;
  // The radius of the tightest bend over how far the yarn's section reaches into the bend. A
  // round yarn reaches as far as its radius. Below 1 the tube folds. Infinite if all yarns are
  // straight.
  double bend;
  // The least width of a tube of the mesh half way between two rings, as a share of the width on
  // the rings.
  double width;
  // How many triangles of the mesh face inwards.
  uint64_t inwards;
  // How many faults `texere_check_fault` writes. At most 100 of a kind are listed.
  uint64_t faults;
  // How many warnings `texere_check_warning` lends.
  uint64_t warnings;
} texere_diagnosis;

// A fault of a cloth.
typedef struct texere_fault {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // A constant whose name begins with TEXERE_FAULT; it says what `value` is.
  uint32_t kind;
  // How bad the fault is, as its kind says. NaN if the kind has no value.
  double value;
  // Where the fault is, mm. NaN if it has no single place.
  double position[3];
  // The fault in words, with the names of its threads: UTF-8 that ends with a zero byte, valid
  // until the check is freed.
  const char *words;
} texere_fault;

// Whether the yarns of a cloth came to rest.
typedef struct texere_report {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // TEXERE_PLACED, TEXERE_AT_REST, TEXERE_NOT_AT_REST or TEXERE_REFUSED.
  uint32_t outcome;
  // The outcome in words, UTF-8 that ends with a zero byte, valid until the cloth is freed.
  const char *words;
  // How many warnings the cloth has: `texere_cloth_warning` lends them.
  uint64_t warnings;
} texere_report;

// Gives the library the bytes of a file that a design names, such as a picture: sets `*data` and
// `*size`, and returns 0. Any other return value says that there is no such file. The bytes have
// to stay valid until the function that was given this callback returns. `path` is UTF-8 of
// `path_length` bytes.
typedef int32_t (*texere_file_callback)(void *user,
                                        const char *path,
                                        size_t path_length,
                                        const uint8_t **data,
                                        size_t *size);

// Takes a piece of a file: `size` bytes, which begin at byte `offset` of the file. The pieces come
// in order, except that at the end earlier bytes may come again with values that are only known
// then. The callback returns 0 to go on; any other value ends the call that was given this
// callback. `data` is valid until the callback returns.
typedef int32_t (*texere_write_callback)(void *user,
                                         uint64_t offset,
                                         const uint8_t *data,
                                         size_t size);

// A description of a device. Its strings end with a zero byte and are valid until the device is
// freed.
typedef struct texere_device_info {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // 1 if yarns of all structures can come to rest on the device, else 0.
  uint32_t settles;
  // The name that opens the device, such as "cpu" or "opencl:0".
  const char *name;
  // The maker's name of the device.
  const char *device;
  // The driver of the device, with the version.
  const char *driver;
  // How much memory the device has, bytes; 0 if it is not known.
  uint64_t memory_bytes;
} texere_device_info;

// Properties of a yarn apart from its control points.
typedef struct texere_yarn {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // The number of its material, counted from 0.
  uint32_t material;
  // The number of its section, counted from 0.
  uint32_t section;
  // 1 if its last control point joins up with its first, else 0.
  uint32_t closed;
  // Its twist, radians per mm; positive is Z twist.
  float twist;
} texere_yarn;

// A control point of a yarn, mm.
typedef struct texere_point {
  // Along the weft or the courses.
  float x;
  // Along the warp or the wales.
  float y;
  // Out of the technical face.
  float z;
  // Half the width of the yarn, across the cloth.
  float half_width;
  // Half the height of the yarn, out of the cloth. In a round yarn it equals `half_width`.
  float half_height;
} texere_point;

// A material of yarns. Its bending stiffness is that of soft cotton; only design files state
// another one. The stiffness counts for knits that come to rest by their energy.
typedef struct texere_material {
  // Its name, UTF-8.
  const char *name;
  // Length of the name, bytes.
  size_t name_length;
  // Linear density, tex; 0 if it is not known.
  float tex;
  // Length of the fibres that stand off the yarn, cm per cm of yarn, 0 to 30. Only pictures show
  // them.
  float hairiness;
  // Red, green and blue, sRGB.
  uint8_t srgb[3];
  // Zero.
  uint8_t reserved;
} texere_material;

// A place in a design's file.
typedef struct texere_place {
  // The file's name, UTF-8 that ends with a zero byte; null if the error has no place. The name
  // is valid until the next call of this thread fails.
  const char *file;
  // The line, counted from 1; 0 if it is not known.
  uint64_t line;
  // The column, in letters counted from 1; 0 if it is not known.
  uint64_t column;
} texere_place;

// Whether and how the yarns of a design come to rest.
typedef struct texere_finish {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // 1 if the yarns come to rest, 0 if they stay where the structure places them.
  uint32_t settle;
  // For knits: a constant whose name begins with TEXERE_LENGTH.
  uint32_t length_kind;
  // A number whose meaning the constant in `length_kind` says.
  float length;
  // For knits: distance of two plates that press the cloth while yarns settle, 0.001 to 1000 mm.
  // 0: no plates.
  float press_mm;
  // For woven cloth: tautness of the warp, 0 to 10, 1 in relaxed cloth.
  float warp_tension;
  // For woven cloth: tautness of the weft, 0 to 10, 1 in relaxed cloth.
  float weft_tension;
  // For woven cloth: how strongly it is pressed flat, 0 to 10, 1 in relaxed cloth.
  float calender;
  // A constant whose name begins with TEXERE_STRETCH.
  uint32_t stretch;
  // For knits: how many passes settling makes at most in each of its two forms, 1 to 1000000.
  // docs/SETTLING.md describes the weighted form and the block form.
  uint32_t passes;
  // The factor by which a stretch multiplies the length of the cloth, 0.5 to 2.
  double stretch_by;
} texere_finish;

// A range of vertices and a range of indices that an update has made again. Both are numbered in
// the whole mesh.
typedef struct texere_change {
  // The number of the first vertex.
  uint64_t first_vertex;
  // How many vertices there are.
  uint64_t vertex_count;
  // The number of the first index.
  uint64_t first_index;
  // How many indices there are: 0 unless the topology is TEXERE_TOPOLOGY_INDEXED.
  uint64_t index_count;
} texere_change;

// The parts of the mesh that an update has made again.
typedef struct texere_update {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // 1 if a new mesh was made, else 0. A new mesh is made in the first update, and for example
  // after an edit by which a yarn outgrew its room. Sizes and draws may then have changed, and
  // vertices may have other numbers.
  uint32_t anew;
  // The ranges that were made again. They are valid until the next update of this live cloth, or
  // until it is freed.
  const struct texere_change *changes;
  // How many changes there are.
  uint64_t change_count;
} texere_update;

// Sizes of a mesh.
typedef struct texere_counts {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // How many rings all yarns have together.
  uint64_t rings;
  // How many vertices. The vertices of a ring at which two chunks meet count twice.
  uint64_t vertices;
  // How many indices.
  uint64_t indices;
  // How many triangles the draws draw.
  uint64_t triangles;
  // How many draws.
  uint64_t draws;
  // How many chunks the mesh is made in.
  uint64_t chunks;
} texere_counts;

// A range of indices that draws a yarn, or a part of one. Triangles are counter-clockwise as seen
// from outside.
typedef struct texere_draw {
  // The number of its first index in the mesh.
  uint64_t first_index;
  // How many indices it has, three for each triangle.
  uint64_t index_count;
  // What to add to an index to get the number of a vertex.
  uint64_t base_vertex;
  // How many vertices the indices of the draw may refer to, from `base_vertex` on.
  uint64_t vertex_count;
  // The yarn, counted from 0.
  uint32_t yarn;
  // Zero.
  uint32_t reserved;
} texere_draw;

// Values that lie in the caller's memory: in an array of their own, or as one member of each
// struct of an array. `data` and `stride` are multiples of the alignment of the values.
typedef struct texere_view {
  // The first value.
  void *data;
  // How many bytes from `data` on belong to the view: at least up to the end of the last value.
  uint64_t size;
  // Bytes from one value to the next: at least the size of a value.
  uint64_t stride;
} texere_view;

// A vertex of a tube.
typedef struct texere_vertex {
  // Position, mm.
  float position[3];
  // Unit normal. It points out of the yarn.
  float normal[3];
} texere_vertex;

// Measures of a cloth. A measure that the cloth does not have, or that can't be known, is NaN.
typedef struct texere_measures {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Wales of a knit; 0 of woven cloth.
  uint32_t wales;
  // Courses of a knit; 0 of woven cloth.
  uint32_t courses;
  // How many materials there are: `texere_cloth_lengths` gives the length of each.
  uint32_t materials;
  // Loops of a knit; 0 of woven cloth.
  uint64_t loops;
  // Width of the cloth, along the weft or the courses, mm.
  double width;
  // Height of the cloth, along the warp or the wales, mm.
  double height;
  // Thickness of the cloth without load, mm.
  double thickness;
  // Length of all yarn, mm.
  double length;
  // Weight, g/m². NaN unless every material that is used has a tex.
  double areal_weight;
  // Crimp of the warp: length of yarn over length of cloth, less 1. NaN of a knit.
  double warp_crimp;
  // Crimp of the weft, in the same way.
  double weft_crimp;
  // The share of the cloth's width that ends cover, from 0 to 1. NaN of a knit.
  double warp_cover;
  // The share of the cloth's height that picks cover, from 0 to 1. NaN of a knit.
  double weft_cover;
  // The share of the cloth's area that ends and picks cover together, from 0 to 1. NaN of a
  // knit.
  double cover;
  // Peirce's cover factor of the warp: ends per inch over the square root of the cotton count.
  // NaN of a knit, and unless every material that is used has a tex.
  double warp_cover_factor;
  // Peirce's cover factor of the weft, in the same way.
  double weft_cover_factor;
  // Peirce's cover factor of the cloth, K1 + K2 - K1 K2 / 28, where K1 and K2 are the factors of
  // warp and weft.
  double cover_factor;
  // Mean length of yarn in a loop, mm. NaN of woven cloth.
  double loop_length;
  // Loops per square centimetre. NaN of woven cloth.
  double loops_per_cm2;
  // Tightness factor: the square root of the tex over the loop length in cm. NaN of woven cloth,
  // and unless all yarns that are used have the same tex.
  double tightness;
} texere_measures;

// Where in the caller's memory a mesh is written: arrays of its own, or members of the caller's
// structs. No two values may overlap.
typedef struct texere_mesh_arrays {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Positions, mm: three `float` for each vertex.
  struct texere_view positions;
  // Unit normals, which point out of the yarn: three `float` for each vertex. With null `data`
  // they are left out.
  struct texere_view normals;
  // Indices, a `uint32_t` each. With null `data` they are left out.
  struct texere_view indices;
} texere_mesh_arrays;

// A ray.
typedef struct texere_ray {
  // Where it starts, mm.
  double origin[3];
  // Where it goes: a direction of any length but 0.
  double direction[3];
} texere_ray;

// What a ray hits first.
typedef struct texere_hit {
  // 1 if the ray hits anything; else 0, and everything else is 0 as well.
  uint32_t found;
  // The yarn, counted from 0.
  uint32_t yarn;
  // The ring before the triangle that is hit, counted from 0 at the start of the yarn.
  uint32_t ring;
  // The corner of the section before the triangle, counted from 0; 0 on a cap.
  uint32_t side;
  // A constant whose name begins with TEXERE_CAP.
  uint32_t cap;
  // The interval of the yarn, counted from 0: interval n lies between control points n and n +
  // 1.
  uint32_t interval;
  // Position along the interval, from 0 to 1.
  double t;
  // Distance from the start of the ray, in lengths of its direction: in mm if the direction has
  // length 1.
  double distance;
  // The point that is hit, mm.
  double position[3];
} texere_hit;

// What a picture shows, and how. `texere_picture_default` fills it in.
typedef struct texere_picture {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Pixels across.
  uint32_t width;
  // Pixels down.
  uint32_t height;
  // How many pixels are drawn for each pixel of the picture, in each direction, 1 or more. Each
  // pixel that is drawn has four samples.
  uint32_t supersampling;
  // 1 if fibres that stand off yarns are drawn, else 0. Cuts never show them, nor do pictures in
  // which threads are narrower than four pixels.
  uint32_t hairs;
  // A constant whose name begins with TEXERE_BACKGROUND.
  uint32_t background;
  // The colour of the background with TEXERE_BACKGROUND_COLOR, sRGB.
  uint8_t color[3];
  // Zero.
  uint8_t reserved;
  // A constant whose name begins with TEXERE_VIEW.
  uint32_t view;
  // 1 if the cloth is turned over sideways, so that its back is seen, else 0.
  uint32_t turned_over;
  // With TEXERE_VIEW_OBLIQUE: turn of the eye about the cloth's middle, radians,
  // counter-clockwise as seen from above.
  float turn;
  // With TEXERE_VIEW_CLOSE_UP and cuts: a point of the cloth, x and y, mm.
  float at[2];
  // With TEXERE_VIEW_CLOSE_UP and cuts: how much of the cloth the picture's width shows, mm.
  float width_mm;
  // With TEXERE_VIEW_EYE and TEXERE_VIEW_PARALLEL: the eye, mm.
  float eye[3];
  // With TEXERE_VIEW_EYE and TEXERE_VIEW_PARALLEL: the point in the middle of the picture, mm.
  float target[3];
  // With TEXERE_VIEW_EYE and TEXERE_VIEW_PARALLEL: the direction that is up in the picture, of
  // any length.
  float up[3];
  // With TEXERE_VIEW_EYE: the angle from the picture's lower to its upper edge, radians, 0.0001
  // to 3.1.
  float field_of_view;
  // With TEXERE_VIEW_PARALLEL: how much the picture's height shows, mm.
  float height_mm;
} texere_picture;

// A chunk of a plan, and where it lies in the mesh.
typedef struct texere_chunk {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // The number of its first vertex in the mesh.
  uint64_t first_vertex;
  // How many vertices it has.
  uint64_t vertex_count;
  // The number of its first index in the mesh.
  uint64_t first_index;
  // How many indices it has. The indices count from its first vertex.
  uint64_t index_count;
  // Its draws. Their indices and vertices are numbered in the whole mesh. They are valid until
  // the plan is freed.
  const struct texere_draw *draws;
  // How many draws it has.
  uint64_t draw_count;
} texere_chunk;

// The box round yarns.
typedef struct texere_extent {
  // The least x, y and z, mm.
  float low[3];
  // The greatest x, y and z, mm.
  float high[3];
} texere_extent;

// What a picture shows at a point.
typedef struct texere_seen {
  // The place on the yarn's surface, mm.
  double position[3];
  // The yarn, counted from 0.
  uint32_t yarn;
  // 1 if a yarn is seen, else 0.
  uint32_t is_yarn;
} texere_seen;

// The objects of OpenCL or Vulkan that a session works with, as numbers. A program casts each to
// the type that its description names.
typedef struct texere_native {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // TEXERE_NATIVE_OPENCL or TEXERE_NATIVE_VULKAN.
  uint32_t kind;
  // The `VkInstance`; 0 with OpenCL.
  uint64_t instance;
  // The `VkPhysicalDevice`; 0 with OpenCL, where the command queue knows its device.
  uint64_t physical_device;
  // The `VkDevice` or `cl_context`.
  uint64_t device;
  // The `VkQueue` or `cl_command_queue` that chunks are made on.
  uint64_t queue;
  // The family of the `VkQueue`; 0 with OpenCL.
  uint32_t queue_family;
  // Zero.
  uint32_t reserved;
} texere_native;

// A part of a buffer on a device.
typedef struct texere_device_buffer {
  // The `cl_mem` or `VkBuffer`; 0 if there are no values.
  uint64_t buffer;
  // Where in the buffer the values begin, bytes.
  uint64_t offset;
  // Size of all values, bytes.
  uint64_t size;
} texere_device_buffer;

// The mesh of a chunk on its device.
//
// With OpenCL, `ready` is the `cl_event` of the last command that writes the buffers. A command of
// the program that reads the buffers has to wait for that event.
//
// With Vulkan, the commands that write the buffers have been submitted to the queue when the
// buffers are lent. A command on that queue needs a memory barrier from the writes of compute
// shaders to its own reads. Before it uses another queue, a program calls `texere_session_wait`.
// While the program submits to the queue, no other thread may call the library with the same
// device. The buffer of vertices may be used as a vertex buffer, a storage buffer or the source of
// a transfer; that of indices as an index buffer, a storage buffer or the source of a transfer.
typedef struct texere_device_mesh {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // TEXERE_NATIVE_OPENCL or TEXERE_NATIVE_VULKAN.
  uint32_t kind;
  // The vertices, a `texere_vertex` each.
  struct texere_device_buffer vertices;
  // The indices, a `uint32_t` each, counted from the chunk's first vertex.
  struct texere_device_buffer indices;
  // The `cl_event` to wait for, valid until the session's next call; 0 with Vulkan.
  uint64_t ready;
} texere_device_mesh;

// A piece of a mesh: vertices, or indices. The piece is valid until the callback returns; its
// draws are valid until the plan is freed.
typedef struct texere_piece {
  // Size of this struct, bytes. The library sets it.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // The chunk that the piece belongs to, counted from 0.
  uint64_t chunk;
  // The number of the chunk's first vertex in the mesh. With TEXERE_TOPOLOGY_INDEXED it is what
  // to add to an index to get the number of a vertex; with TEXERE_TOPOLOGY_SHARED that is
  // `base_vertex` of each draw.
  uint64_t base_vertex;
  // The draws of the chunk. Their indices and vertices are numbered in the whole mesh.
  const struct texere_draw *draws;
  // How many draws the chunk has.
  uint64_t draw_count;
  // Vertices; null in a piece of indices.
  const struct texere_vertex *vertices;
  // The number of the first of these vertices in the mesh.
  uint64_t first_vertex;
  // How many vertices the piece has.
  uint64_t vertex_count;
  // Indices; null in a piece of vertices.
  const uint32_t *indices;
  // The number of the first of these indices in the mesh.
  uint64_t first_index;
  // How many indices the piece has.
  uint64_t index_count;
} texere_piece;

// Takes a piece of a mesh. It returns 0 to go on; any other value ends the call that was given
// this callback.
typedef int32_t (*texere_piece_callback)(void *user, const struct texere_piece *piece);

// The lap of a guide at one course: in front of the needles, the guide moves from one needle space
// to another. Space n lies between needle n - 1 and needle n.
typedef struct texere_lap {
  // The needle space before the overlap, 0 to 512.
  int32_t from;
  // The needle space after the overlap, 0 to 512, and at most two needles from `from`. Where it
  // equals `from`, the yarn is laid in and makes no loop.
  int32_t to;
} texere_lap;

// A guide bar.
typedef struct texere_bar {
  // Its chain: a lap for each course, beginning with the course that is knitted first.
  const struct texere_lap *laps;
  // How many laps, 1 to 4096. The first lap follows the last one again.
  uint64_t lap_count;
  // The yarn of each guide, counted from 0, or TEXERE_NO_YARN. Null with a `guide_count` of 0:
  // all guides have yarn 0.
  const uint32_t *threading;
  // How many guides `threading` is for. The guides after them hold the same yarns again, from
  // the first one of `threading` on.
  uint64_t guide_count;
  // Run-in: length of yarn for a rack of 480 courses, mm. 0: the laps give it.
  double run_in_mm;
  // By how many needles the whole bar is moved towards the high numbers.
  int32_t offset;
  // Zero.
  uint32_t reserved;
} texere_bar;

// A yarn of a knit.
typedef struct texere_knit_yarn {
  // Its diameter, mm. `texere_diameter` works it out from a linear density in tex.
  double diameter_mm;
  // Twist, radians per mm; positive is Z twist.
  float twist;
  // The number of its material, from 0.
  uint32_t material;
  // The number of its section, from 0.
  uint32_t section;
  // Zero.
  uint32_t reserved;
} texere_knit_yarn;

// The cross-section of yarns. Every shape except a polygon has the area of the round yarn.
typedef struct texere_section {
  // A constant whose name begins with TEXERE_SECTION.
  uint32_t shape;
  // How many plies of TEXERE_SECTION_LOBED, or corners of TEXERE_SECTION_POLYGON.
  uint32_t count;
  // Width over height, 0.05 to 20.
  float aspect;
  // A number whose meaning the constant of the shape says.
  float form;
  // The corners of a polygon, counter-clockwise: for each corner its x and its y, in radii of
  // the yarn.
  const float *corners;
} texere_section;

// Materials and sections. Yarns refer to them by their number, counted from 0.
typedef struct texere_looks {
  // The materials. Null with a `material_count` of 0: one material, undyed yarn.
  const struct texere_material *materials;
  // How many materials.
  uint64_t material_count;
  // The sections. Null with a `section_count` of 0: one section, a circle.
  const struct texere_section *sections;
  // How many sections.
  uint64_t section_count;
} texere_looks;

// The Jacquard of a guide bar: an image whose colours displace single guides. Each cell of the
// image is for one guide and one round of the bar's chain. The image repeats beyond its edges.
typedef struct texere_jacquard {
  // How many guides the image is wide. 0: the bar is no Jacquard bar, and the rest is not read.
  uint32_t guides;
  // How many rounds of the chain the image is high.
  uint32_t rounds;
  // The number of each cell's colour, counted from 0. There are `guides` times `rounds` cells:
  // those of the round knitted first, from guide 0 on, then those of the next round.
  const uint8_t *colors;
  // How many colours there are, 1 to 256.
  uint64_t color_count;
  // Two numbers, each 0 or 1, for each colour at each lap of the chain. They are the needles by
  // which the colour moves the beginning and the end of the lap towards the high numbers. The
  // numbers of the first colour come first, lap after lap, 2 times `lap_count` of them; then
  // those of the next colour.
  const uint8_t *shifts;
} texere_jacquard;

// A warp knit as the caller's arrays.
typedef struct texere_warp_knit {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // A constant whose name begins with TEXERE_CELLS.
  uint32_t cells;
  // How many wales: a multiple of `guide_count` of every bar that has a threading, and of
  // `guides` of every Jacquard.
  uint32_t wales;
  // How many courses: a multiple of `lap_count` of every bar, and for a Jacquard bar of
  // `lap_count` times `rounds`.
  uint32_t courses;
  // How many copies of these wales and courses lie along the courses, and how many along the
  // wales; each 1 or more.
  uint32_t copies[2];
  // What the design is called, UTF-8.
  const char *name;
  // Length of the name, bytes.
  size_t name_length;
  // The guide bars, the front one first.
  const struct texere_bar *bars;
  // How many guide bars, 1 to 64.
  uint64_t bar_count;
  // The yarns.
  const struct texere_knit_yarn *yarns;
  // How many yarns.
  uint64_t yarn_count;
  // Distance from one wale to the next, mm.
  double wale_mm;
  // Distance from one course to the next, mm.
  double course_mm;
  // The materials and sections that the yarns refer to.
  struct texere_looks looks;
  // The Jacquards of the guide bars, `bar_count` of them, or null if no bar has one.
  const struct texere_jacquard *jacquards;
} texere_warp_knit;

// The stitch in one wale of one course.
typedef struct texere_stitch {
  // A constant whose name begins with TEXERE_STITCH.
  uint32_t kind;
  // By how many needles the loop moves, -256 to 256: positive to the right, negative to the
  // left. Only the two kinds that begin with TEXERE_STITCH_MOVED read it.
  int32_t moved;
} texere_stitch;

// A weft knit as the caller's arrays: one repeat of stitches, and its copies.
typedef struct texere_weft_knit {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Beds of needles, 1 or 2. With `jacquard` it has to be 0: a Jacquard with a backing is
  // knitted on two beds, one without on one bed.
  uint32_t beds;
  // A constant whose name begins with TEXERE_CELLS.
  uint32_t cells;
  // How many copies of the repeat lie along the courses, and how many along the wales; each 1 or
  // more.
  uint32_t copies[2];
  // With `jacquard`: what the back needles knit, a constant whose name begins with
  // TEXERE_BACKING. Else 0.
  uint32_t backing;
  // What the design is called, UTF-8.
  const char *name;
  // Length of the name, bytes.
  size_t name_length;
  // Wales of the repeat, 1 to 65536.
  uint64_t wales;
  // Courses of the repeat, or rows of the picture in `jacquard`: 1 to 65536.
  uint64_t courses;
  // The stitches, `wales` times `courses` of them: course after course from the first, which is
  // the bottom one, and in each course from left to right as seen from the technical face. Null
  // with `jacquard`.
  const struct texere_stitch *stitches;
  // The yarns that the courses take in turn, from the first course on: numbers in `yarns`,
  // counted from 0. After the last one the first one follows again. Null with a `turn_count` of
  // 0: all courses take yarn 0, or with `jacquard` the yarns of the picture. If `courses` is not
  // a multiple of `turn_count`, the chart is repeated upwards until the number of its courses is
  // such a multiple.
  const uint32_t *turn;
  // How many numbers `turn` has.
  uint64_t turn_count;
  // The yarns.
  const struct texere_knit_yarn *yarns;
  // How many yarns.
  uint64_t yarn_count;
  // Distance from one wale to the next, mm.
  double wale_mm;
  // Distance from one course to the next, mm.
  double course_mm;
  // The mean length of yarn in a loop that settling aims for, mm. 0: loops take the length that
  // they need.
  double loop_length_mm;
  // The materials and sections that the yarns refer to.
  struct texere_looks looks;
  // A Jacquard picture: for each cell the number of its yarn in `yarns`, counted from 0. There
  // are `wales` times `courses` cells, row after row from the bottom, and in each row from left
  // to right. Null for a knit that `stitches` gives. A row becomes one course for each of its
  // yarns, in the order of their numbers. The front needles knit the course's yarn where the
  // picture has that yarn. The yarn floats past the other front needles.
  const uint32_t *jacquard;
} texere_weft_knit;

// An end or a pick.
typedef struct texere_thread {
  // Width of the strip of cloth that the thread takes, mm. The distance of two neighbours is
  // half the sum of their spacings.
  double spacing_mm;
  // Diameter that the yarn has when it is round, mm. `texere_diameter` works it out from a
  // linear density in tex.
  double diameter_mm;
  // Width over height in the cloth, 0.1 to 10; 0 stands for 1, which is round.
  float flatness;
  // Stiffness against bending when the yarns come to rest, 0.01 to 100; 1 for cotton yarn of the
  // same diameter. 0 stands for 1.
  float stiffness;
  // How firmly the section keeps its shape when the yarns come to rest, 0.01 to 100; 1 for
  // cotton of ordinary twist. Hard-twisted yarn is firmer and stays rounder, and filament
  // without twist spreads flat at 0.1. 0 stands for what follows from `twist`, and for 1 without
  // twist.
  float firmness;
  // Twist, radians per mm; positive is Z twist.
  float twist;
  // The number of its material, from 0.
  uint32_t material;
  // The number of its section, from 0.
  uint32_t section;
  // Least area that the yarn's section keeps when the yarns come to rest, as a share of the
  // round yarn's section, up to 1: fibres can't be packed more closely. 0 stands for that of
  // cotton, 0.7476.
  float least_area;
  // Unused, 0.
  uint32_t reserved;
} texere_thread;

// Lists of numbers, which lie one behind the other in one array.
typedef struct texere_lists {
  // The numbers of all lists.
  const uint32_t *numbers;
  // Where each list begins in `numbers`, counted from 0, and at the end how many numbers there
  // are in all: one offset more than there are lists. Null: every list has one number.
  const uint64_t *offsets;
} texere_lists;

// A shaft draft. Shafts and treadles count from 1, as weavers write them. The number 0 stands for
// none; a number that a list has twice counts once.
typedef struct texere_draft {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // 0 if lifted shafts carry their ends to the face, 1 if they carry them to the back.
  uint32_t sinking_shed;
  // How many shafts, 1 to 100000.
  uint32_t shafts;
  // How many treadles, 0 to 100000. 0 stands for a loom without treadles, such as a dobby loom.
  uint32_t treadles;
  // For each end the shafts that carry it: as many lists as ends.
  struct texere_lists threading;
  // For each treadle the shafts that are tied to it: as many lists as treadles.
  struct texere_lists tie_up;
  // For each pick the treadles that it presses: as many lists as picks. On a loom without
  // treadles this is the lift plan, which has for each pick the shafts that it lifts.
  struct texere_lists treadling;
} texere_draft;

// Woven cloth as the caller's arrays.
typedef struct texere_woven {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // A constant whose name begins with TEXERE_SHAPE.
  uint32_t shape;
  // A constant whose name begins with TEXERE_RELIEF.
  uint32_t relief;
  // 1 if the weft turns back round the outermost ends, 0 if each pick is cut at both edges.
  uint32_t selvedge;
  // A constant whose name begins with TEXERE_CRIMP.
  uint32_t crimp;
  // The warp's share of the crimp, 0 (straight ends) to 1 (straight picks), with
  // TEXERE_CRIMP_SHARE.
  float warp_share;
  // What the design is called, UTF-8.
  const char *name;
  // Length of the name, bytes.
  size_t name_length;
  // How many ends.
  uint64_t ends;
  // How many picks.
  uint64_t picks;
  // A row of bits for each pick. The library only reads them. Row 0 is the first pick, at the
  // bottom of the cloth. Bit 0 (the lowest) of a row's first byte is end 1, at the left; bit 0
  // of its second byte is end 9. A bit is 1 where the end lies on the face. A row has (`ends` +
  // 7) / 8 bytes, and `stride` bytes lie between the beginnings of two rows. With null `data`
  // the cloth is that of `draft`.
  struct texere_view drawdown;
  // The ends from the left: `ends` of them.
  const struct texere_thread *warp;
  // The picks from the bottom: `picks` of them.
  const struct texere_thread *weft;
  // The materials and sections that the threads refer to.
  struct texere_looks looks;
  // The shaft draft that weaves the cloth, or null for a cloth that `drawdown` gives. WIF files
  // and pictures of the draft show its shafts and treadles.
  const struct texere_draft *draft;
} texere_woven;

// Yarns as the caller's arrays.
typedef struct texere_yarn_arrays {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Tension of the splines through the control points, from 0 to below 1; 0 is usual.
  float tension;
  // How many yarns there are.
  uint64_t yarns;
  // `yarns + 1` numbers: for each yarn the number of its first point, counted from 0 in
  // `points`, and at the end how many points there are in all.
  const uint64_t *offsets;
  // The control points of all yarns, yarn after yarn.
  const struct texere_point *points;
  // For each yarn 1 if its last point joins up with its first, else 0. Null: no yarn is closed.
  const uint8_t *closed;
  // For each yarn its twist, radians per mm; positive is Z twist. Null: no yarn is twisted.
  const float *twist;
} texere_yarn_arrays;

// How many yarns and control points a handle of yarns has.
typedef struct texere_yarn_counts {
  // Size of this struct, bytes. The caller sets it.
  uint32_t struct_size;
  // Tension of the splines through the control points.
  float tension;
  // How many yarns there are.
  uint64_t yarns;
  // How many control points all yarns have together.
  uint64_t points;
} texere_yarn_counts;

// Where on its yarn a vertex lies, for shaders and textures.
typedef struct texere_attribute {
  // The yarn, counted from 0.
  uint32_t yarn;
  // The angle round the section from its first corner, radians. The first corner turns with the
  // yarn's twist.
  float angle;
  // The length of the yarn from its start to the vertex's ring, mm.
  float along;
  // The unit tangent of the yarn at the vertex's ring.
  float tangent[3];
} texere_attribute;

// A vertex in 12 bytes, half the size of `texere_vertex`. docs/CONVENTIONS.md says how it is
// unpacked.
typedef struct texere_packed_vertex {
  // The position. Each coordinate is a whole number of steps of `quantum_mm` of
  // `texere_settings`, and the lowest 21 bits of that number are kept. The two words are one
  // number of 64 bits, the first word its lower half: x has bits 0 to 20, y bits 21 to 41, z
  // bits 42 to 62.
  uint32_t position[2];
  // The unit normal, mapped to the octahedron and from there to a square: two coordinates from
  // -1 to 1, in steps of 1/32767.
  int16_t normal[2];
} texere_packed_vertex;

// A ring: a sample of a yarn's centreline.
typedef struct texere_ring {
  // Centre, mm.
  float centre[3];
  // Half the width of the yarn, mm.
  float half_width;
  // Unit tangent.
  float tangent[3];
  // Turn of the section about the tangent, against the frame TEXERE_FRAME_UPRIGHT, in 1/2^32 of
  // a full turn.
  uint32_t roll;
  // Half the height of the yarn, mm.
  float half_height;
  // Growth of the half width along the yarn, mm per mm.
  float width_growth;
  // Growth of the half height along the yarn, mm per mm.
  float height_growth;
  // Turn of the yarn's outline about the tangent, against the frame TEXERE_FRAME_UPRIGHT, in
  // 1/2^32 of a full turn. It is 0 where the height of the yarn stands upright, and another
  // number on, for example, a flattened yarn that runs steeply up or down.
  uint32_t lean;
} texere_ring;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The number of the binary interface of the loaded library: TEXERE_ABI of the header that belongs
// to it.
uint32_t texere_abi(void);

// The version of this library, such as "0.1.0". The string ends with a zero byte and is valid as
// long as the library is loaded.
const char *texere_version(void);

// Checks a cloth: measures how near its yarns come to one another and how tightly they bend, and
// looks for faults and for single changes of the design that cure them. It also looks for faults
// of a mesh with `settings`, which may be null: then those of `texere_settings_default` apply. Two
// yarns pierce one another if they come short of touching by more than the share `accuracy`.
// TEXERE_ACCURACY is usual. `run` may be null.
//
// The call succeeds for a cloth with faults. It fails with TEXERE_ARGUMENT for settings out of
// range and for an accuracy that is not from 0 to below 1, and with TEXERE_CANCELLED if `run` was
// cancelled.
enum texere_status texere_check_new(const struct texere_cloth *cloth,
                                    const struct texere_settings *settings,
                                    double accuracy,
                                    const struct texere_run *run,
                                    struct texere_check **out);

// Writes the result of a check. The caller sets `diagnosis->struct_size` before the call.
enum texere_status texere_check_diagnosis(const struct texere_check *check,
                                          struct texere_diagnosis *diagnosis);

// Writes fault `number`, counted from 0. The caller sets `fault->struct_size` before the call.
//
// Fails with TEXERE_ARGUMENT for a number that is too high.
enum texere_status texere_check_fault(const struct texere_check *check,
                                      uint64_t number,
                                      struct texere_fault *fault);

// Lends warning `number`, counted from 0: writes its address to `words`. It is UTF-8 that ends
// with a zero byte, valid until the check is freed. Warnings do not count as faults.
//
// Fails with TEXERE_ARGUMENT for a number that is too high.
enum texere_status texere_check_warning(const struct texere_check *check,
                                        uint64_t number,
                                        const char **words);

// Lends the faults and their cures as JSON, as `texere check --json` prints them: UTF-8 that ends
// with a zero byte, valid until the check is freed.
enum texere_status texere_check_json(const struct texere_check *check, const char **json);

// Lends the counts and measures of the cloth as JSON, as `texere inspect --json` prints them:
// UTF-8 that ends with a zero byte, valid until the check is freed.
enum texere_status texere_check_measures_json(const struct texere_check *check, const char **json);

// Frees a check. A null handle is allowed.
void texere_check_free(struct texere_check *check);

// Makes the cloth of a design: places its yarns, and lets them come to rest on `device` if the
// design asks for it. Rest by energy is worked out on the CPU if the device can't. `run` may be
// null.
//
// The call succeeds even if the yarns do not come to rest; `texere_cloth_report` says whether they
// did. Threads of woven cloth that can't settle at all stay where the structure places them. The
// call fails with TEXERE_DESIGN if the cloth can't be made or a knit can't settle, with
// TEXERE_UNSUPPORTED if yarns can't settle on the device, and with TEXERE_CANCELLED if `run` was
// cancelled.
enum texere_status texere_cloth_rest(const struct texere_design *design,
                                     const struct texere_device *device,
                                     const struct texere_run *run,
                                     struct texere_cloth **out);

// Makes the cloth of a design with its yarns where the structure places them, even if the design
// asks that they come to rest.
//
// Fails with TEXERE_DESIGN if the cloth can't be made.
enum texere_status texere_cloth_placed(const struct texere_design *design,
                                       struct texere_cloth **out);

// Writes whether the yarns of a cloth came to rest. The caller sets `report->struct_size` before
// the call.
enum texere_status texere_cloth_report(const struct texere_cloth *cloth,
                                       struct texere_report *report);

// Lends warning `number` of a cloth, counted from 0: writes the address of the warning's text to
// `words`. The text is UTF-8 that ends with a zero byte, valid until the cloth is freed.
//
// Fails with TEXERE_ARGUMENT if the cloth has no warning of that number.
enum texere_status texere_cloth_warning(const struct texere_cloth *cloth,
                                        uint64_t number,
                                        const char **words);

// Gives the yarns of a cloth, as a handle of their own. They stay valid when the cloth is freed.
enum texere_status texere_cloth_yarns(const struct texere_cloth *cloth, struct texere_yarns **out);

// Frees a cloth. A null handle is allowed.
void texere_cloth_free(struct texere_cloth *cloth);

// Reads a design from a file: a draft of WIF (`.wif`), Fiberworks (`.dtx`) or WeavePoint (`.wpo`),
// a design file (`.toml`) or a program of a knitting machine (`.k`).
//
// Fails with TEXERE_IO if the file can't be read, and with TEXERE_DESIGN if it holds no valid
// design; `texere_error_place` then says where the file is at fault.
enum texere_status texere_design_read(const char *path,
                                      size_t path_length,
                                      struct texere_design **out);

// Reads a design that the caller has in memory. `name` stands for the file's name: its ending says
// what kind of design it is, and errors show it. `files` is called for each file that the design
// names, with `user` as its first argument. `files` may be null if the design names no files.
//
// Fails as `texere_design_read` does.
enum texere_status texere_design_read_memory(const char *name,
                                             size_t name_length,
                                             const uint8_t *data,
                                             size_t size,
                                             texere_file_callback files,
                                             void *user,
                                             struct texere_design **out);

// Writes a design to a file that `texere_design_read` reads. The ending of `path` says which:
// `.toml` for texere's own design file, which holds woven cloth, weft knits that were read from a
// chart or a picture, and warp knits without a Jacquard bar; `.wif` for a WIF 1.1 draft, which
// holds woven cloth, and leaves out what drafts don't have; `.k` or `.knitout` for a knitout file,
// which holds weft knits that were read from one. An existing file of that name is replaced only
// once the new one is complete.
//
// Fails with TEXERE_ARGUMENT for another ending, with TEXERE_UNSUPPORTED for a design that the
// file can't hold, and with TEXERE_IO if the file can't be written.
enum texere_status texere_design_write(const struct texere_design *design,
                                       const char *path,
                                       size_t path_length);

// Writes a design, not to a file but to `callback`, which gets the bytes that
// `texere_design_write` would write. `format` is a constant whose name begins with
// TEXERE_DESIGN_FORMAT. The callback runs on the calling thread, with `user` as its first
// argument.
//
// Fails with TEXERE_UNSUPPORTED for a design that the format can't hold, and with TEXERE_CANCELLED
// if the callback returned a number other than 0. The bytes that the callback had been given by
// then are not a complete file.
enum texere_status texere_design_write_to(const struct texere_design *design,
                                          uint32_t format,
                                          texere_write_callback callback,
                                          void *user);

// Frees a design. A null handle is allowed. Cloths that were made of the design stay valid.
void texere_design_free(struct texere_design *design);

// Opens a device by its name: "auto" for the best one, "cpu", "cpu-serial", "opencl", "opencl:1",
// "wgpu" and so on. A `name_length` of 0 is "auto".
//
// Fails with TEXERE_DEVICE if there is no device of that name, and with TEXERE_UNSUPPORTED if the
// library was built without the API that the device needs.
enum texere_status texere_device_open(const char *name,
                                      size_t name_length,
                                      struct texere_device **out);

// Writes a description of a device. The caller sets `info->struct_size` before the call.
enum texere_status texere_device_describe(const struct texere_device *device,
                                          struct texere_device_info *info);

// Frees a device. A null handle is allowed. Handles that were made with the device stay valid.
void texere_device_free(struct texere_device *device);

// Draws a design on squared paper, in a `.png` file: the draft or the point paper of woven cloth,
// the stitch chart of a weft knit, the lapping diagram of a warp knit. `back` is 1 to show the
// cloth turned over sideways, else 0. An existing file of that name is replaced only once the new
// one is complete.
//
// Fails with TEXERE_ARGUMENT for a cloth that is too large to draw, and with TEXERE_IO if the file
// can't be written.
enum texere_status texere_design_draft(const struct texere_design *design,
                                       uint32_t back,
                                       const char *path,
                                       size_t path_length);

// Draws a design on squared paper, and hands the bytes of a `.png` file to `callback`: the bytes
// that `texere_design_draft` writes. The callback runs on the calling thread, with `user` as its
// first argument.
//
// Fails with TEXERE_ARGUMENT for a cloth that is too large to draw, and with TEXERE_CANCELLED if
// the callback returned a number other than 0. The bytes that came before then are not a complete
// file.
enum texere_status texere_design_draft_to(const struct texere_design *design,
                                          uint32_t back,
                                          texere_write_callback callback,
                                          void *user);

// Sets whether the warp is up where an end and a pick cross. Ends and picks count from 0. Both
// threads then lie as the structure places them, even if they lay otherwise before.
//
// Fails with TEXERE_ARGUMENT if there is no such crossing, if `up` is neither 0 nor 1, and if the
// cloth has no weave: because it is a knit, or because only its yarns were given.
enum texere_status texere_live_set_lift(const struct texere_live *live,
                                        uint64_t end,
                                        uint64_t pick,
                                        uint32_t up);

// Sets many lifts at once: where `ends` ends from `first_end` on cross `picks` picks from
// `first_pick` on. `up` has a byte for each of these crossings, 1 if the warp is up, else 0. The
// bytes lie pick after pick, and those of a pick in the order of the ends.
//
// Fails as `texere_live_set_lift` does.
enum texere_status texere_live_set_drawdown(const struct texere_live *live,
                                            uint64_t first_end,
                                            uint64_t ends,
                                            uint64_t first_pick,
                                            uint64_t picks,
                                            const uint8_t *up);

// Writes to `up` 1 if the warp is up where an end and a pick cross, else 0. Ends and picks count
// from 0.
//
// Fails as `texere_live_set_lift` does.
enum texere_status texere_live_lift(const struct texere_live *live,
                                    uint64_t end,
                                    uint64_t pick,
                                    uint32_t *up);

// Replaces a yarn, counted from 0: its properties and its control points. There may be more or
// fewer points than before.
//
// Fails with TEXERE_ARGUMENT if there is no such yarn, material or section, and for control points
// that no yarn can have. The cloth then stays as it was.
enum texere_status texere_live_set_yarn(const struct texere_live *live,
                                        uint64_t yarn,
                                        const struct texere_yarn *what,
                                        const struct texere_point *points,
                                        size_t point_count);

// Gives a yarn, counted from 0, other control points. There may be more or fewer than before.
//
// Fails as `texere_live_set_yarn` does.
enum texere_status texere_live_set_points(const struct texere_live *live,
                                          uint64_t yarn,
                                          const struct texere_point *points,
                                          size_t point_count);

// Writes the properties of a yarn, counted from 0, as they are now. `texere_live_yarns` gives its
// control points. The caller sets `what->struct_size` before the call.
//
// Fails with TEXERE_ARGUMENT if there is no such yarn.
enum texere_status texere_live_yarn(const struct texere_live *live,
                                    uint64_t yarn,
                                    struct texere_yarn *what);

// Replaces a material, counted from 0. The mesh holds no colours, so no part of it has to be made
// again. The bending stiffness that the material has from a design stays.
//
// Fails with TEXERE_ARGUMENT if there is no such material, and for values that no material can
// have.
enum texere_status texere_live_set_material(const struct texere_live *live,
                                            uint64_t number,
                                            const struct texere_material *material);

// Writes a material, counted from 0, as it is now. Its name ends with a zero byte. The name is
// valid until the next call of this function with this live cloth, or until the live cloth is
// freed.
//
// Fails with TEXERE_ARGUMENT if there is no such material.
enum texere_status texere_live_material(const struct texere_live *live,
                                        uint64_t number,
                                        struct texere_material *material);

// Sets the tension of the splines of all yarns, from 0 to below 1. The next update makes the whole
// mesh again.
//
// Fails with TEXERE_ARGUMENT for a tension outside these limits.
enum texere_status texere_live_set_tension(const struct texere_live *live, float tension);

// Replaces the structure by that of a design, such as a knit with another stitch or a weave with
// other threads. The yarns lie as the new structure places them. The tension of splines stays. The
// next update does not make yarns again that are the same in both structures.
//
// Fails with TEXERE_DESIGN if the yarns of the structure can't be made, and as
// `texere_live_of_cloth` does.
enum texere_status texere_live_set_structure(const struct texere_live *live,
                                             const struct texere_design *design);

// Replaces all yarns. The next update does not make yarns again that stay the same. From then on
// the live cloth has no weave, so its lifts can't be set.
//
// Fails with TEXERE_ARGUMENT for yarns whose splines have another tension, and as
// `texere_live_of_cloth` does.
enum texere_status texere_live_set_yarns(const struct texere_live *live,
                                         const struct texere_yarns *yarns);

// Replaces all yarns by those of the same cloth at rest, and keeps the weave. A thread whose lift
// is set later lies as the structure places it, among the yarns at rest.
//
// Fails with TEXERE_ARGUMENT for yarns whose splines have another tension, for more or fewer yarns
// than the live cloth has, and for other sections.
enum texere_status texere_live_set_rest(const struct texere_live *live,
                                        const struct texere_yarns *yarns);

// What went wrong in the last call of this thread that failed, with all causes: UTF-8 that ends
// with a zero byte. The text is empty if no call of this thread has failed. It is valid until the
// next call of this thread fails.
const char *texere_error_message(void);

// Writes where the last failure of this thread lies: its place in a design's file.
//
// Fails with TEXERE_ARGUMENT for a null `place`.
enum texere_status texere_error_place(struct texere_place *place);

// Writes the finish of a design. The caller sets `finish->struct_size` before the call.
enum texere_status texere_design_finish(const struct texere_design *design,
                                        struct texere_finish *finish);

// Makes a copy of a design with the finish `finish`.
//
// Fails with TEXERE_ARGUMENT for a value out of range, and for a finish that the structure does
// not have, such as a stretch of a knit.
enum texere_status texere_design_finished(const struct texere_design *design,
                                          const struct texere_finish *finish,
                                          struct texere_design **out);

// Makes a live cloth of a cloth, with its mesh on a device. If the cloth is woven, its lifts can
// be set. `settings` may be null, and then those of `texere_settings_default` apply.
//
// Fails with TEXERE_ARGUMENT for settings out of range, with TEXERE_MEMORY if the mesh has no room
// on the device, and with TEXERE_UNSUPPORTED if the device can't keep a mesh.
enum texere_status texere_live_of_cloth(const struct texere_cloth *cloth,
                                        const struct texere_device *device,
                                        const struct texere_settings *settings,
                                        struct texere_live **out);

// Makes a live cloth of yarns, with its mesh on a device. Yarns have no weave, so lifts can't be
// set. `settings` may be null, and then those of `texere_settings_default` apply.
//
// Fails as `texere_live_of_cloth` does.
enum texere_status texere_live_of_yarns(const struct texere_yarns *yarns,
                                        const struct texere_device *device,
                                        const struct texere_settings *settings,
                                        struct texere_live **out);

// Makes again the parts of the mesh that edits have changed, and writes which parts they are. The
// first update makes the whole mesh. `run` may be null. The caller sets `update->struct_size`
// before the call.
//
// Fails with TEXERE_DEVICE or TEXERE_MEMORY if the device fails, and with TEXERE_CANCELLED if
// `run` was cancelled. The next update then makes the same parts.
enum texere_status texere_live_update(const struct texere_live *live,
                                      const struct texere_run *run,
                                      struct texere_update *update);

// Writes the sizes of a live cloth's mesh as of its last update. The numbers of vertices and
// indices include the room between yarns, into which yarns can grow. The caller sets
// `counts->struct_size` before the call.
enum texere_status texere_live_counts(const struct texere_live *live, struct texere_counts *counts);

// Lends the draws of a live cloth's mesh as of its last update. `texere_live_counts` says how many
// there are. Indices between two draws belong to the room into which yarns can grow, and are not
// drawn. The draws are valid until the next update, or until the live cloth is freed.
enum texere_status texere_live_draws(const struct texere_live *live,
                                     const struct texere_draw **draws);

// Gives the yarns of a live cloth as they are now, as a handle of their own. They stay as they are
// when the live cloth is edited or freed.
enum texere_status texere_live_yarns(const struct texere_live *live, struct texere_yarns **out);

// Frees a live cloth. A null handle is allowed.
void texere_live_free(struct texere_live *live);

// Makes attributes as well as the mesh, from the next update on. That update makes the whole mesh
// again. From then on an edit of a yarn changes the whole yarn, because the length along the yarn
// changes everywhere behind the edit.
enum texere_status texere_live_keep_attributes(const struct texere_live *live);

// Reads the attributes of a live cloth's vertices into the caller's memory: a `texere_attribute`
// for each vertex that `texere_live_counts` counts, in the order of the mesh's vertices. `run` may
// be null. The attributes in the room between yarns, into which yarns can grow, are undefined.
//
// Fails with TEXERE_ARGUMENT if `texere_live_keep_attributes` has not been called, if
// `texere_live_update` has not been called since then and since the last edit, and for a view that
// is too small, misaligned or null. Fails with TEXERE_CANCELLED if `run` was cancelled.
enum texere_status texere_live_attributes(const struct texere_live *live,
                                          const struct texere_run *run,
                                          const struct texere_view *attributes);

// Reads the attributes of a range of vertices, for example a change of the last update, into the
// caller's memory: a `texere_attribute` for each of the `change->vertex_count` vertices.
//
// Fails as `texere_live_attributes` does, and with TEXERE_ARGUMENT if the range does not lie
// within the mesh.
enum texere_status texere_live_read_attributes(const struct texere_live *live,
                                               const struct texere_change *change,
                                               const struct texere_view *attributes);

// Reads the whole mesh of a live cloth into the caller's memory. `run` may be null. The contents
// of the room between yarns, into which yarns can grow, are undefined.
//
// Fails with TEXERE_ARGUMENT if `vertex_count` or `index_count` is not what `texere_live_counts`
// says, and if `texere_live_update` has to be called first, after an edit for example. Fails with
// TEXERE_CANCELLED if `run` was cancelled.
enum texere_status texere_live_mesh(const struct texere_live *live,
                                    const struct texere_run *run,
                                    struct texere_vertex *vertices,
                                    uint64_t vertex_count,
                                    uint32_t *indices,
                                    uint64_t index_count);

// Reads a range of the mesh of a live cloth into the caller's memory, such as a change of the last
// update. Indices count from the base vertex of their draw.
//
// Fails with TEXERE_ARGUMENT if the range does not lie within the mesh, if `vertex_count` or
// `index_count` is not what the range says, and if `texere_live_update` has to be called first,
// after an edit for example.
enum texere_status texere_live_read(const struct texere_live *live,
                                    const struct texere_change *change,
                                    struct texere_vertex *vertices,
                                    uint64_t vertex_count,
                                    uint32_t *indices,
                                    uint64_t index_count);

// Writes the diameter, mm, of a yarn with the linear density `tex`, tex, and the density
// `density`, g/cm³. The density is that of the yarn with the air in it; 0.909 is usual for cotton.
//
// Fails with TEXERE_ARGUMENT for numbers that are not above 0 and finite.
enum texere_status texere_diameter(double tex, double density, double *diameter_mm);

// Writes the measures of a cloth. The caller sets `measures->struct_size` before the call.
//
// Fails with TEXERE_DESIGN if they can't be taken.
enum texere_status texere_cloth_measures(const struct texere_cloth *cloth,
                                         struct texere_measures *measures);

// Writes the length of yarn of each material of a cloth, mm. `materials` of
// `texere_cloth_measures` says how many numbers that is.
//
// Fails with TEXERE_ARGUMENT if `count` is another number.
enum texere_status texere_cloth_lengths(const struct texere_cloth *cloth,
                                        double *lengths,
                                        uint64_t count);

// Makes the mesh of a plan in the caller's memory, as an array of `texere_vertex` and one of
// indices. `run` may be null.
//
// Fails with TEXERE_ARGUMENT if `vertex_count` or `index_count` is not what `texere_plan_counts`
// says, and with TEXERE_CANCELLED if `run` was cancelled. After a failure the contents of the
// memory are undefined.
enum texere_status texere_plan_mesh(const struct texere_plan *plan,
                                    const struct texere_run *run,
                                    struct texere_vertex *vertices,
                                    uint64_t vertex_count,
                                    uint32_t *indices,
                                    uint64_t index_count);

// Makes the mesh of a plan in arrays that the caller chooses. Positions and normals go to arrays
// of their own, to members of the caller's structs, or one behind the other as in `texere_vertex`.
// `run` may be null. `texere_plan_counts` says how many vertices and indices there are. Memory
// between values stays as it is.
//
// The call is fastest with each normal right behind its position, 24 bytes from vertex to vertex,
// and with indices that lie side by side: the mesh is then not copied value by value.
//
// Fails with TEXERE_ARGUMENT for a view that is too small or misaligned and for null positions,
// and with TEXERE_CANCELLED if `run` was cancelled. After a failure the contents of the memory are
// undefined.
enum texere_status texere_plan_mesh_arrays(const struct texere_plan *plan,
                                           const struct texere_run *run,
                                           const struct texere_mesh_arrays *arrays);

// Makes the packed vertices of a plan in the caller's memory: a `texere_packed_vertex` for each
// vertex that `texere_plan_counts` counts, in the order of the mesh's vertices. `run` may be null.
//
// Fails with TEXERE_ARGUMENT for a view that is too small, misaligned or null, with
// TEXERE_CANCELLED if `run` was cancelled, and with TEXERE_UNSUPPORTED if the device can't make
// them.
enum texere_status texere_plan_packed(const struct texere_plan *plan,
                                      const struct texere_run *run,
                                      const struct texere_view *packed);

// Makes the attributes of a plan's vertices in the caller's memory: a `texere_attribute` for each
// vertex that `texere_plan_counts` counts, in the order of the mesh's vertices. `run` may be null.
//
// Fails as `texere_plan_packed` does.
enum texere_status texere_plan_attributes(const struct texere_plan *plan,
                                          const struct texere_run *run,
                                          const struct texere_view *attributes);

// Makes the centrelines of a plan's yarns in the caller's memory: a `texere_ring` for each ring
// that `texere_plan_counts` counts, yarn after yarn as `texere_plan_ring_offsets` says. `run` may
// be null.
//
// Fails as `texere_plan_packed` does.
enum texere_status texere_plan_trajectory(const struct texere_plan *plan,
                                          const struct texere_run *run,
                                          const struct texere_view *rings);

// Makes a picker of yarns. `settings` may be null, and then those of `texere_settings_default`
// apply.
//
// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_MEMORY if memory does not
// suffice.
enum texere_status texere_picker_new(const struct texere_yarns *yarns,
                                     const struct texere_settings *settings,
                                     struct texere_picker **out);

// Writes which triangle a ray hits first, from either side. If several lie at the same distance,
// it is the first along the yarns. A ray whose direction is zero, or whose numbers are not finite,
// hits nothing.
enum texere_status texere_picker_pick(const struct texere_picker *picker,
                                      const struct texere_ray *ray,
                                      struct texere_hit *hit);

// Writes what a weaver or a knitter calls the place of a hit in a cloth, such as `end 3 at pick 4,
// cotton`. If the cloth is knitted by a program, the place in the program follows. The hit is one
// of a picker of the cloth's yarns.
//
// `*length` becomes the length of the text in bytes. The text and a zero byte go to `words`, which
// has room for `size` bytes. If `size` is 0, only the length is written, and `words` may be null.
//
// Fails with TEXERE_ARGUMENT if the cloth has no such place, if the place is not where the hit is,
// for example because the hit is one of live cloth that was edited, and if `size` is neither 0 nor
// above the length.
enum texere_status texere_cloth_place(const struct texere_cloth *cloth,
                                      const struct texere_hit *hit,
                                      char *words,
                                      size_t size,
                                      size_t *length);

// Writes what a ray hits first in a live cloth as it is now, with edits that no update has brought
// to the mesh yet.
//
// Fails with TEXERE_MEMORY if memory does not suffice.
enum texere_status texere_live_pick(const struct texere_live *live,
                                    const struct texere_ray *ray,
                                    struct texere_hit *hit);

// Writes what a weaver or a knitter calls the place of a hit in a live cloth, such as `end 3 at
// pick 4, cotton`, in the same way as `texere_cloth_place`. If the yarns come from no design, the
// text only names the yarn.
//
// Fails with TEXERE_ARGUMENT if the live cloth has no such place, and if the place is no longer
// where the hit is.
enum texere_status texere_live_place(const struct texere_live *live,
                                     const struct texere_hit *hit,
                                     char *words,
                                     size_t size,
                                     size_t *length);

// Frees a picker. A null handle is allowed.
void texere_picker_free(struct texere_picker *picker);

// Writes the usual picture: the whole cloth from above its face, 1600 by 1200 pixels of sixteen
// samples each, with fibres, on the ground. The caller sets `picture->struct_size` before the
// call.
enum texere_status texere_picture_default(struct texere_picture *picture);

// Plans the mesh of yarns on a device. `settings` may be null, and then those of
// `texere_settings_default` apply.
//
// Fails with TEXERE_ARGUMENT for settings out of range.
enum texere_status texere_plan_new(const struct texere_yarns *yarns,
                                   const struct texere_device *device,
                                   const struct texere_settings *settings,
                                   struct texere_plan **out);

// Writes the sizes of a plan's mesh. The caller sets `counts->struct_size` before the call.
enum texere_status texere_plan_counts(const struct texere_plan *plan, struct texere_counts *counts);

// Lends the draws of a plan's mesh. `texere_plan_counts` says how many there are. They are valid
// until the plan is freed.
//
// Fails with TEXERE_ARGUMENT for a null `draws`.
enum texere_status texere_plan_draws(const struct texere_plan *plan,
                                     const struct texere_draw **draws);

// Lends for each yarn the number of its first ring, and at the end how many rings there are in
// all. That is one number more than the plan has yarns. The numbers are valid until the plan is
// freed. `*count` becomes how many numbers there are.
//
// Fails with TEXERE_ARGUMENT for a null `offsets` or `count`.
enum texere_status texere_plan_ring_offsets(const struct texere_plan *plan,
                                            const uint64_t **offsets,
                                            uint64_t *count);

// Writes where a chunk of a plan lies in the mesh. Chunks count from 0; `texere_plan_counts` says
// how many there are. The caller sets `chunk->struct_size` before the call.
//
// Fails with TEXERE_ARGUMENT if there is no chunk of that number.
enum texere_status texere_plan_chunk(const struct texere_plan *plan,
                                     uint64_t number,
                                     struct texere_chunk *chunk);

// Frees a plan. A null handle is allowed.
void texere_plan_free(struct texere_plan *plan);

// Opens a device for pictures: "auto" for the best one, "wgpu", "wgpu:1" and so on. A
// `name_length` of 0 is "auto".
//
// Fails with TEXERE_DEVICE if there is no such device, and with TEXERE_UNSUPPORTED if the library
// was built without pictures.
enum texere_status texere_renderer_open(const char *name,
                                        size_t name_length,
                                        struct texere_renderer **out);

// Sends yarns to a renderer, which shows them from now on in place of those before. `settings` may
// be null, and then settings that suit a picture apply. Topology and caps of the settings have no
// effect. `run` may be null.
//
// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_CANCELLED if `run` was
// cancelled. After a cancelled call the renderer shows nothing.
enum texere_status texere_renderer_show(const struct texere_renderer *renderer,
                                        const struct texere_yarns *yarns,
                                        const struct texere_settings *settings,
                                        const struct texere_run *run);

// Writes the box round the yarns that a renderer shows.
//
// Fails with TEXERE_ARGUMENT if it shows none.
enum texere_status texere_renderer_extent(const struct texere_renderer *renderer,
                                          struct texere_extent *extent);

// Makes a picture in the caller's memory. `pixels` has a row of bytes for each row of the picture,
// from the top. A row has four bytes for each pixel, from the left: red, green, blue (sRGB) and
// alpha. `pixels->stride` is the number of bytes from one row to the next, at least four times the
// width. Alpha is 255 unless the background is TEXERE_BACKGROUND_NOTHING. Colours are not
// multiplied by alpha. `run` may be null.
//
// Fails with TEXERE_ARGUMENT if the renderer shows no yarns, for a picture that is out of range or
// larger than the device takes, and for memory that is too small. Fails with TEXERE_CANCELLED if
// `run` was cancelled. After a failure the memory is as it was.
enum texere_status texere_renderer_picture(const struct texere_renderer *renderer,
                                           const struct texere_picture *picture,
                                           const struct texere_run *run,
                                           const struct texere_view *pixels);

// Makes a picture in a `.png` file. The file has alpha if the background is
// TEXERE_BACKGROUND_NOTHING. `run` may be null. An existing file of that name is replaced only
// once the new one is complete.
//
// Fails as `texere_renderer_picture` does, and with TEXERE_IO if the file can't be written.
enum texere_status texere_renderer_write(const struct texere_renderer *renderer,
                                         const struct texere_picture *picture,
                                         const struct texere_run *run,
                                         const char *path,
                                         size_t path_length);

// Makes a picture and hands the bytes of a `.png` file to `callback`: the bytes that
// `texere_renderer_write` writes. `run` may be null. The callback runs on the calling thread, with
// `user` as its first argument, after the picture has been made.
//
// Fails as `texere_renderer_picture` does, and with TEXERE_CANCELLED if the callback returned a
// number other than 0. The bytes that came before then are not a complete file.
enum texere_status texere_renderer_write_to(const struct texere_renderer *renderer,
                                            const struct texere_picture *picture,
                                            const struct texere_run *run,
                                            texere_write_callback callback,
                                            void *user);

// Writes what the last picture of a renderer shows at a point, in pixels from its left and upper
// edges. No yarn is seen outside the picture, before the first picture, and after a picture that
// was cancelled.
//
// Fails with TEXERE_ARGUMENT if the renderer shows no yarns.
enum texere_status texere_renderer_seen(const struct texere_renderer *renderer,
                                        float x,
                                        float y,
                                        struct texere_seen *seen);

// Frees a renderer. A null handle is allowed.
void texere_renderer_free(struct texere_renderer *renderer);

// Makes a run, which is not cancelled.
//
// Fails with TEXERE_ARGUMENT for a null `out`.
enum texere_status texere_run_new(struct texere_run **out);

// Asks the call that `run` was given to, and every later one, to end with TEXERE_CANCELLED. Any
// thread may ask.
enum texere_status texere_run_cancel(const struct texere_run *run);

// Writes the share of the call that is done, from 0 to 1. Any thread may ask.
//
// Fails with TEXERE_ARGUMENT for a null `share`.
enum texere_status texere_run_progress(const struct texere_run *run, double *share);

// Frees a run. A null handle is allowed.
void texere_run_free(struct texere_run *run);

// Starts a session of a plan: sends the control points of its yarns to the device. `run` may be
// null. The plan may be freed afterwards.
//
// Fails with TEXERE_UNSUPPORTED if the device has no buffers of OpenCL or Vulkan to lend, as with
// "cpu", and with TEXERE_CANCELLED if `run` was cancelled.
enum texere_status texere_session_new(const struct texere_plan *plan,
                                      const struct texere_run *run,
                                      struct texere_session **out);

// Writes the objects of Vulkan or OpenCL that a session works with, for a program that draws or
// computes with the session's buffers. The objects are valid until the session is freed. The
// caller sets `native->struct_size` before the call.
enum texere_status texere_session_native(const struct texere_session *session,
                                         struct texere_native *native);

// Makes the mesh of a chunk on the device, and lends the buffers that hold it: vertices as
// `texere_vertex`, and indices that count from the chunk's first vertex. `texere_plan_chunk` says
// how many vertices and indices there are. The call may return before the device is done;
// `texere_device_mesh` says what to wait for. The caller sets `mesh->struct_size` before the call.
//
// The buffers belong to the library, and the program may only read them. They stay valid until the
// session is freed. They hold this chunk's mesh until two other chunks have been made.
//
// Fails with TEXERE_ARGUMENT if the plan has no chunk of that number.
enum texere_status texere_session_mesh(const struct texere_session *session,
                                       uint64_t number,
                                       struct texere_device_mesh *mesh);

// Waits until the device has finished all work of the session.
enum texere_status texere_session_wait(const struct texere_session *session);

// Waits for the mesh of a chunk that `texere_session_mesh` has made, and copies it to the caller's
// memory.
//
// Fails with TEXERE_ARGUMENT if `vertex_count` or `index_count` is not what `texere_plan_chunk`
// says, and if the chunk was not made or another chunk has taken its buffers.
enum texere_status texere_session_read(const struct texere_session *session,
                                       uint64_t number,
                                       struct texere_vertex *vertices,
                                       uint64_t vertex_count,
                                       uint32_t *indices,
                                       uint64_t index_count);

// Frees a session with its buffers. A null handle is allowed. None of the program's own commands
// may be using the buffers then.
void texere_session_free(struct texere_session *session);

// Writes the settings that suit yarns: the usual ones, with as many subdivisions as the yarns'
// twist needs, and with as many sides as a polygon among their sections has corners. The caller
// sets `settings->struct_size` before the call.
enum texere_status texere_settings_default(const struct texere_yarns *yarns,
                                           struct texere_settings *settings);

// Makes the mesh of a plan piece by piece, in bounded memory: the control points and two chunks at
// a time. Chunks come in order. All vertices of a chunk come before its indices. A piece of
// indices may end within a triangle. With TEXERE_TOPOLOGY_SHARED the pattern of indices that all
// draws use comes first, in a piece of chunk 0. `run` may be null. The callback runs on the
// calling thread, with `user` as its first argument.
//
// Fails with TEXERE_CANCELLED if `run` was cancelled, or if the callback returned a number other
// than 0.
enum texere_status texere_plan_stream(const struct texere_plan *plan,
                                      const struct texere_run *run,
                                      texere_piece_callback callback,
                                      void *user);

// Makes a design of a warp knit from the caller's arrays, which are copied. By default its yarns
// come to rest; `texere_design_finished` makes a design with another finish.
//
// Fails with TEXERE_ARGUMENT for arrays from which no knit can be made. The message names the
// array, the element (counted from 0), the value and the limit.
enum texere_status texere_design_warp_knit(const struct texere_warp_knit *knit,
                                           struct texere_design **out);

// Makes a design of a weft knit from the caller's arrays, which are copied. By default its yarns
// come to rest; `texere_design_finished` makes a design with another finish.
//
// Fails with TEXERE_ARGUMENT for arrays from which no knit can be made. The message names the
// array, the element (counted from 0), the value and the limit.
enum texere_status texere_design_weft_knit(const struct texere_weft_knit *knit,
                                           struct texere_design **out);

// Makes a design of woven cloth from the caller's arrays, which are copied. By default its yarns
// come to rest; `texere_design_finished` makes a design with another finish.
//
// Fails with TEXERE_ARGUMENT for arrays from which no cloth can be made. The message names the
// array, the element (counted from 0), the value and the limit.
enum texere_status texere_design_woven(const struct texere_woven *woven,
                                       struct texere_design **out);

// Makes the mesh of a plan and writes it to a file, `.glb`, `.ply`, `.stl`, `.obj` or `.usda`, in
// bounded memory. `run` may be null. An existing file of that name is replaced only once the new
// one is complete.
//
// Fails with TEXERE_IO if the file can't be written, with TEXERE_UNSUPPORTED if the mesh is too
// large for the format, and with TEXERE_CANCELLED if `run` was cancelled.
enum texere_status texere_plan_write(const struct texere_plan *plan,
                                     const struct texere_run *run,
                                     const char *path,
                                     size_t path_length);

// Makes the mesh of a plan and hands the bytes of a file to `callback`, in bounded memory: the
// bytes that `texere_plan_write` writes, or those of a packed, a compressed or an instanced file.
// `format` is a constant whose name begins with TEXERE_FORMAT. `run` may be null. The callback
// runs on the calling thread, with `user` as its first argument.
//
// Fails with TEXERE_UNSUPPORTED if the mesh is too large for the format, and with TEXERE_CANCELLED
// if `run` was cancelled, or if the callback returned a number other than 0. The bytes that came
// before then are not a complete file.
enum texere_status texere_plan_write_to(const struct texere_plan *plan,
                                        const struct texere_run *run,
                                        uint32_t format,
                                        texere_write_callback callback,
                                        void *user);

// Makes yarns, round or flattened, of the caller's arrays, which are copied.
//
// Fails with TEXERE_ARGUMENT for arrays from which no yarns can be made. The message names the
// yarn, the point, the value and the limit.
enum texere_status texere_yarns_new(const struct texere_yarn_arrays *arrays,
                                    struct texere_yarns **out);

// Reads yarns from a `.yarns` file.
//
// Fails with TEXERE_IO if the file can't be read, and with TEXERE_DESIGN if it holds no yarns.
enum texere_status texere_yarns_read(const char *path,
                                     size_t path_length,
                                     struct texere_yarns **out);

// Reads yarns from the caller's memory, which holds the bytes of a `.yarns` file. Errors call the
// file `name`.
//
// Fails with TEXERE_DESIGN if the bytes hold no yarns.
enum texere_status texere_yarns_read_memory(const char *name,
                                            size_t name_length,
                                            const uint8_t *data,
                                            size_t size,
                                            struct texere_yarns **out);

// Reads curves that another program wrote, as round yarns: Binary Curve Collection, `.bcc`; the
// polylines of Wavefront OBJ, `.obj`; or the text form of Universal Scene Description, `.usda` or
// `.usd`. Reads yarns of TexGen, `.tg3`, too, which keep the sections that they have there.
// `unit_mm` is the length of the file's unit, and `diameter_mm` the diameter of all yarns. 0 for
// either stands for what a `.usda`, `.usd` or `.tg3` file says. For other files `diameter_mm` must
// not be 0, and a `unit_mm` of 0 stands for 1 mm.
//
// Fails with TEXERE_IO if the file can't be read, and with TEXERE_DESIGN if it holds no curves or
// lacks the diameter.
enum texere_status texere_yarns_read_curves(const char *path,
                                            size_t path_length,
                                            float unit_mm,
                                            float diameter_mm,
                                            struct texere_yarns **out);

// Writes yarns to a file. `.yarns` is texere's own form, which keeps every bit of them;
// `texere_yarns_read` reads it. `.bcc` and `.usda` are centrelines for other programs: `.bcc`
// holds control points alone, `.usda` also diameters and colours. An existing file of that name is
// replaced only once the new one is complete.
//
// Fails with TEXERE_IO if the file can't be written, and with TEXERE_UNSUPPORTED for yarns that
// `.bcc` can't hold.
enum texere_status texere_yarns_write(const struct texere_yarns *yarns,
                                      const char *path,
                                      size_t path_length);

// Writes yarns and hands the bytes of the file to `callback`: the bytes that `texere_yarns_write`
// writes, or those of a file of straight lines with TEXERE_YARNS_FORMAT_LINEAR_USDA. `format` is a
// constant whose name begins with TEXERE_YARNS_FORMAT. The callback runs on the calling thread,
// with `user` as its first argument.
//
// Fails with TEXERE_UNSUPPORTED for yarns that TEXERE_YARNS_FORMAT_BCC can't hold, and with
// TEXERE_CANCELLED if the callback returned a number other than 0. The bytes that came before then
// are not a complete file.
enum texere_status texere_yarns_write_to(const struct texere_yarns *yarns,
                                         uint32_t format,
                                         texere_write_callback callback,
                                         void *user);

// Writes how many yarns and control points there are. The caller sets `counts->struct_size` before
// the call.
enum texere_status texere_yarns_counts(const struct texere_yarns *yarns,
                                       struct texere_yarn_counts *counts);

// Copies to the caller's memory where the points of each yarn begin, as in `offsets` of
// `texere_yarn_arrays`, and the control points. With the numbers of `texere_yarns_counts` there
// are `yarns + 1` offsets and `points` points.
//
// Fails with TEXERE_ARGUMENT if `offset_count` or `point_count` is another number.
enum texere_status texere_yarns_points(const struct texere_yarns *yarns,
                                       uint64_t *offsets,
                                       uint64_t offset_count,
                                       struct texere_point *points,
                                       uint64_t point_count);

// Frees yarns. A null handle is allowed. Plans that were made of the yarns stay valid.
void texere_yarns_free(struct texere_yarns *yarns);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TEXERE_H */
