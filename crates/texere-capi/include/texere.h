// texere: textile designs to yarn-level 3D geometry.
//
// A function that can fail gives a texere_status; texere_error_message says in words what went
// wrong, and texere_error_place where in a design's file. What a `_free` function takes may be null,
// or freed already. A handle is looked up and never followed, so a handle that was freed is refused.
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

// The number of the binary interface. A program compares it with `texere_abi` of the library
// that it has loaded: they are equal, or the program can't use that library.
#define TEXERE_ABI 1

// The share by which yarns may come short of touching and still count as touching, as a rule.
#define TEXERE_ACCURACY 0.015

// More yarn lies in a place than there is room for, or too many parts of yarns to measure them
// pair by pair. The value is the yarns' volume over the room.
#define TEXERE_FAULT_CROWDED 0

// Two yarns pierce one another. The value is how near they come: 1 where they just touch.
#define TEXERE_FAULT_PIERCES 1

// A bend is tighter than the tube is thick. The value is its radius in radii of the yarn.
#define TEXERE_FAULT_FOLDS 2

// A thread lies too close to the one before for crossing threads to pass. The value is their
// distance over the one that is needed. There is no one place.
#define TEXERE_FAULT_JAMS 3

// The cloth does not hang together. The value is the number of its pieces. There is no one place.
#define TEXERE_FAULT_APART 4

// The mesh is wrung between two rings. The value is its width there in radii of the yarn.
#define TEXERE_FAULT_WRUNG 5

// Triangles of the mesh face inwards. The value is how many; the place is that of the first.
#define TEXERE_FAULT_INSIDE_OUT 6

// A knitting machine can't do a step of the program. There is neither a value nor a place.
#define TEXERE_FAULT_MACHINE 7

// The yarns are where the structure places them: the design does not ask for more.
#define TEXERE_PLACED 0

// The yarns came to rest.
#define TEXERE_AT_REST 1

// The yarns settled and are not at rest; `words` of the report says what is left.
#define TEXERE_NOT_AT_REST 2

// The yarns are where the structure places them, for they can't come to rest; `words` says why.
#define TEXERE_REFUSED 3

// The structure's own choice: loops of a knit reach the length that its gauge asks for, or are
// free.
#define TEXERE_LENGTH_USUAL 0

// No yarn is drawn through.
#define TEXERE_LENGTH_HELD 1

// Yarns get `length` times their length, 0.5 to 2.
#define TEXERE_LENGTH_GIVEN 2

// Yarns take the length that they need; `length` is a tension that draws them in, 0 to 0.1.
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

// An ellipse: `aspect`.
#define TEXERE_SECTION_ELLIPSE 1

// Two arcs that meet in two edges: `aspect`, and as `form` the height of the edges above the
// middle, in half heights, -0.9 to 0.9.
#define TEXERE_SECTION_LENTICULAR 2

// An ellipse whose height is |sin|^`form`: `aspect`, and a `form` from 0.1 to 4; 1 is an ellipse.
#define TEXERE_SECTION_POWER_ELLIPSE 3

// Plies that are twisted together: `count` of them, 2 to 12.
#define TEXERE_SECTION_LOBED 4

// The outline in `corners`, 3 to 256 of them.
#define TEXERE_SECTION_POLYGON 5

// No cap: the hit is on the side of the yarn.
#define TEXERE_CAP_NONE 0

// The cap that closes the start of the yarn.
#define TEXERE_CAP_START 1

// The cap that closes the end of the yarn.
#define TEXERE_CAP_FINISH 2

// The whole cloth from straight above its face.
#define TEXERE_VIEW_FACE 0

// The whole cloth from above its lower edge, turned by `turn`.
#define TEXERE_VIEW_OBLIQUE 1

// A stretch of `width_mm` round the point `at`, from above and aside.
#define TEXERE_VIEW_CLOSE_UP 2

// A cut across the ends, through the point `at`, `width_mm` of it.
#define TEXERE_VIEW_CUT_WARP 3

// A cut across the picks, through the point `at`, `width_mm` of it.
#define TEXERE_VIEW_CUT_WEFT 4

// From `eye` to `target`, with `field_of_view`.
#define TEXERE_VIEW_EYE 5

// From `eye` to `target` with parallel lines of sight; the picture shows `height_mm`.
#define TEXERE_VIEW_PARALLEL 6

// Light grey ground that the cloth lies on and casts its shadow on.
#define TEXERE_BACKGROUND_GROUND 0

// The colour `color`.
#define TEXERE_BACKGROUND_COLOR 1

// Nothing: alpha says how much of each pixel is yarn.
#define TEXERE_BACKGROUND_NOTHING 2

// Sections stand with their side level. Yarns that are too steep for that are carried along.
#define TEXERE_FRAME_UPRIGHT 0

// Sections are carried along the yarn without turning.
#define TEXERE_FRAME_ROTATION_MINIMIZING 1

// Three indices a triangle, counted from the base vertex of their draw.
#define TEXERE_TOPOLOGY_INDEXED 0

// One pattern of indices for all draws.
#define TEXERE_TOPOLOGY_SHARED 1

// No indices.
#define TEXERE_TOPOLOGY_NONE 2

// As many control points as the bends of a yarn need.
#define TEXERE_CELLS_ROUND 0

// Equally many control points for each stitch.
#define TEXERE_CELLS_EVEN 1

// The yarn of an empty guide.
#define TEXERE_NO_YARN 4294967295

// The front needle knits.
#define TEXERE_STITCH_KNIT 0

// The back needle knits.
#define TEXERE_STITCH_PURL 1

// Front and back needle both knit, on two beds.
#define TEXERE_STITCH_BOTH 2

// The needle takes the yarn and keeps its loops; on two beds it is the front needle.
#define TEXERE_STITCH_TUCK 3

// The back needle tucks, on two beds.
#define TEXERE_STITCH_BACK_TUCK 4

// The yarn floats past.
#define TEXERE_STITCH_MISS 5

// The front needle knits, and its loop moves by `moved` needles, in front of the others.
#define TEXERE_STITCH_MOVED 6

// The front needle knits, and its loop moves by `moved` needles, behind the others.
#define TEXERE_STITCH_MOVED_BEHIND 7

// Threads bend round one another as round threads do, and floats lie flat.
#define TEXERE_SHAPE_ROUND 0

// One control point a crossing, and one before and after.
#define TEXERE_SHAPE_CROSSING 1

// Threads that lie too close are only reported.
#define TEXERE_RELIEF_REPORT 0

// Threads that lie too close are flattened.
#define TEXERE_RELIEF_FLATTEN 1

// Threads that lie too close are made thinner.
#define TEXERE_RELIEF_SHRINK 2

// The stiffer set stays the straighter.
#define TEXERE_CRIMP_STIFFNESS 0

// The warp has `warp_share` of the crimp.
#define TEXERE_CRIMP_SHARE 1

// glTF 2.0 in one binary file, `.glb`.
#define TEXERE_FORMAT_GLB 0

// Binary PLY, `.ply`.
#define TEXERE_FORMAT_PLY 1

// How a call ended.
typedef enum texere_status {
  // The call did what it is for.
  TEXERE_OK = 0,
  // A null or misaligned pointer, a wrong size, a handle that was freed or is of another kind,
  // or a value out of its range.
  TEXERE_ARGUMENT = 1,
  // The design can't be read, or its cloth can't be made.
  TEXERE_DESIGN = 2,
  // There is no such device, or it failed.
  TEXERE_DEVICE = 3,
  // Memory did not suffice, on the host or on the device.
  TEXERE_MEMORY = 4,
  // A file can't be read or written.
  TEXERE_IO = 5,
  // The call ended early since `texere_run_cancel` was called.
  TEXERE_CANCELLED = 6,
  // The library was built without what the call needs, or the device can't do it.
  TEXERE_UNSUPPORTED = 7,
  // A fault of the library. It was caught, and the library can still be used.
  TEXERE_PANIC = 8,
} texere_status;

// The check of a cloth: how near its yarns come to one another, its faults, and their cures.
typedef struct texere_check texere_check;

// The cloth of a design: its yarns, and how they came to rest.
typedef struct texere_cloth texere_cloth;

// A design: a WIF draft, a design file or a program of a knitting machine that was read, or a
// structure by arrays.
typedef struct texere_design texere_design;

// An open device: a GPU, or the CPU.
typedef struct texere_device texere_device;

// A cloth that is being edited, and its whole mesh on a device. One thread at a time may use it: a
// call fails with TEXERE_ARGUMENT while a call of another thread is using it.
//
// An edit counts at once for `texere_live_yarns` and `texere_live_pick`. `texere_live_update`
// brings it to the mesh. To undo an edit, set the old value again.
typedef struct texere_live texere_live;

// Says what a ray hits first of the mesh of yarns, without the mesh.
typedef struct texere_picker texere_picker;

// The plan of a mesh: yarns, settings and a device. It knows every size before anything runs.
//
// A mesh is made in chunks. Each is small enough that a call whose run is cancelled ends within
// 50 ms. How many there are depends on the device, and on how many cores the machine has. Where a
// chunk ends inside a yarn, its last ring is also the first of the next one.
typedef struct texere_plan texere_plan;

// A device that makes pictures, and the yarns that it shows. One thread at a time may use it: a
// call while another thread's is under way fails with TEXERE_ARGUMENT.
typedef struct texere_renderer texere_renderer;

// A call that takes long, as other threads see it: how far it has come, and whether it is to end.
// One run may be given to one call after another; each starts it at 0.
typedef struct texere_run texere_run;

// A plan at work on its device, whose mesh stays there, chunk by chunk. Two chunks are there at a
// time: a chunk's buffers hold its mesh until `texere_session_mesh` makes the next chunk but one.
//
// One thread at a time may use a session. A call while another thread's is under way fails with
// TEXERE_ARGUMENT.
typedef struct texere_session texere_session;

// Yarns: their control points, sections and materials.
typedef struct texere_yarns texere_yarns;

// What can be chosen about a mesh. `texere_settings_default` fills it in.
typedef struct texere_settings {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Points that are inserted between two control points, from 0.
  uint32_t subdivisions;
  // Sides of the tubes, from 3.
  uint32_t sides;
  // A number that begins with TEXERE_FRAME.
  uint32_t frame;
  // A number that begins with TEXERE_TOPOLOGY.
  uint32_t topology;
  // 1 if the ends of yarns are closed, else 0.
  uint32_t caps;
  // The step of the grid that packed positions lie on, mm: a power of two from 2^-24 to 2^11.
  float quantum_mm;
} texere_settings;

// What a check has found.
typedef struct texere_diagnosis {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // 1 if there is no fault, else 0.
  uint32_t clean;
  // "clean", or the faults in one phrase, such as "pierces itself, folds": UTF-8 that ends with
  // a zero byte, valid until the check is freed.
  const char *words;
  // Contacts that are nearer than this pierce.
  double touching;
  // How near yarns come to one another at the least: 1 where they just touch. Infinite where
  // none come near; NaN where all places are crowded.
  double clearance;
  // How many places there are where two yarns come near one another.
  uint64_t contacts;
  // How many of the contacts are nearer than 1 by more than 0.001.
  uint64_t below_one;
  // The radius of the tightest bend in radii of the yarn. Infinite where all yarns are straight.
  double bend;
  // The least width of a tube of the mesh half way between two rings, in radii of the yarn.
  double width;
  // How many triangles of the mesh face inwards.
  uint64_t inwards;
  // How many faults `texere_check_fault` gives: 100 of each kind at most.
  uint64_t faults;
  // How many warnings `texere_check_warning` gives.
  uint64_t warnings;
} texere_diagnosis;

// A fault of a cloth.
typedef struct texere_fault {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // A number that begins with TEXERE_FAULT; it says what `value` is.
  uint32_t kind;
  // How bad it is. NaN where the kind has no value.
  double value;
  // Where it is, mm. NaN where it has no one place.
  double position[3];
  // The fault in words, with the threads that it is of: UTF-8 that ends with a zero byte, valid
  // until the check is freed.
  const char *words;
} texere_fault;

// How the yarns of a cloth came to rest.
typedef struct texere_report {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // TEXERE_PLACED, TEXERE_AT_REST, TEXERE_NOT_AT_REST or TEXERE_REFUSED.
  uint32_t outcome;
  // The outcome in words, UTF-8 that ends with a zero byte, valid until the cloth is freed.
  const char *words;
  // How many warnings `texere_cloth_warning` gives.
  uint64_t warnings;
} texere_report;

// Gives the bytes of a file that a design names, such as a picture: sets `*data` and `*size`, and
// gives 0. Anything else than 0 says that there is no such file. The bytes have to stay valid
// until the function that was given this callback returns. `path` is UTF-8 of `path_length` bytes.
typedef int32_t (*texere_file_callback)(void *user,
                                        const char *path,
                                        size_t path_length,
                                        const uint8_t **data,
                                        size_t *size);

// What a device is. Strings end with a zero byte and are valid until the device is freed.
typedef struct texere_device_info {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // 1 if yarns can come to rest on it, else 0.
  uint32_t settles;
  // The name that opens it, such as "cpu" or "opencl:0".
  const char *name;
  // The device as its maker calls it.
  const char *device;
  // Its driver, with the version.
  const char *driver;
  // Bytes of memory that it has; 0 where it does not say so.
  uint64_t memory_bytes;
} texere_device_info;

// What a yarn is made of, apart from its control points.
typedef struct texere_yarn {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Its material, from 0.
  uint32_t material;
  // Its section, from 0.
  uint32_t section;
  // 1 if its last control point joins up with its first, else 0.
  uint32_t closed;
  // Its twist, radians a mm; positive is Z twist.
  float twist;
} texere_yarn;

// A place on the centreline of a yarn, mm.
typedef struct texere_point {
  // Along the weft or the courses.
  float x;
  // Along the warp or the wales.
  float y;
  // Out of the technical face.
  float z;
  // Half the width of the yarn, across the cloth.
  float half_width;
  // Half the height of the yarn, out of the cloth. A round yarn has its half width.
  float half_height;
} texere_point;

// What yarns are made of.
typedef struct texere_material {
  // Its name, UTF-8.
  const char *name;
  // Bytes of the name.
  size_t name_length;
  // Linear density, tex; 0 where it is not known.
  float tex;
  // Fibres that stand off the yarn, cm per cm of yarn, 0 to 30. Only pictures show them.
  float hairiness;
  // Red, green and blue, sRGB.
  uint8_t srgb[3];
  // Zero.
  uint8_t reserved;
} texere_material;

// A place in a design's file.
typedef struct texere_place {
  // The file's name, UTF-8 that ends with a zero byte; null where the error has no place. It is
  // valid until the next call of this thread fails.
  const char *file;
  // The line, from 1; 0 where it is not known.
  uint64_t line;
  // The column, in letters from 1; 0 where it is not known.
  uint64_t column;
} texere_place;

// Whether and how the yarns of a design come to rest.
typedef struct texere_finish {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // 1 if the yarns come to rest, 0 if they stay where the structure places them.
  uint32_t settle;
  // Of knits: a number that begins with TEXERE_LENGTH.
  uint32_t length_kind;
  // What the kind of length says.
  float length;
  // Of knits: distance of two plates that press the cloth, 0.001 to 1000 mm; 0: no plates.
  float press_mm;
  // Of woven cloth: tautness of the warp, 0 to 10, 1 in relaxed cloth.
  float warp_tension;
  // Of woven cloth: tautness of the weft, 0 to 10, 1 in relaxed cloth.
  float weft_tension;
  // Of woven cloth: how strongly it is pressed flat, 0 to 10, 1 in relaxed cloth.
  float calender;
  // A number that begins with TEXERE_STRETCH.
  uint32_t stretch;
  // The most passes of either form of a knit, 1 to 1000000.
  uint32_t passes;
  // How many times as long stretched cloth becomes, 0.5 to 2.
  double stretch_by;
} texere_finish;

// A stretch of vertices and indices that an update has made again. Both count from the start of
// the whole mesh.
typedef struct texere_change {
  // The first vertex.
  uint64_t first_vertex;
  // How many vertices there are.
  uint64_t vertex_count;
  // The first index.
  uint64_t first_index;
  // How many indices there are: none unless the topology is TEXERE_TOPOLOGY_INDEXED.
  uint64_t index_count;
} texere_change;

// What an update has made again.
typedef struct texere_update {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // 1 where the mesh was begun: in the first update, and after an edit that makes a yarn outgrow
  // its room, when sizes and places of everything may be others. Else 0.
  uint32_t anew;
  // The stretches that were made again, valid until the next update of this live cloth, or until
  // it is freed.
  const struct texere_change *changes;
  // How many there are.
  uint64_t change_count;
} texere_update;

// Sizes of a mesh.
typedef struct texere_counts {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Rings of all yarns.
  uint64_t rings;
  // Vertices. A ring at which two chunks meet counts twice.
  uint64_t vertices;
  // Indices.
  uint64_t indices;
  // Triangles that the draws draw.
  uint64_t triangles;
  // Draws.
  uint64_t draws;
  // Chunks that the mesh is made in.
  uint64_t chunks;
} texere_counts;

// A range of indices that draws a yarn, or a part of one. Triangles are counter-clockwise seen
// from outside.
typedef struct texere_draw {
  // The first of its indices.
  uint64_t first_index;
  // How many indices it has, three a triangle.
  uint64_t index_count;
  // What to add to an index to get the number of a vertex.
  uint64_t base_vertex;
  // How many vertices from `base_vertex` on its indices may refer to.
  uint64_t vertex_count;
  // The yarn, from 0.
  uint32_t yarn;
  // Zero.
  uint32_t reserved;
} texere_draw;

// A vertex of a tube.
typedef struct texere_vertex {
  // Position, mm.
  float position[3];
  // Unit normal, out of the yarn.
  float normal[3];
} texere_vertex;

// Measures of a cloth. What a cloth does not have, or what is not known of it, is NaN.
typedef struct texere_measures {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Wales of a knit; 0 of woven cloth.
  uint32_t wales;
  // Courses of a knit; 0 of woven cloth.
  uint32_t courses;
  // How many materials there are: `texere_cloth_lengths` gives the length of each.
  uint32_t materials;
  // Loops of a knit; 0 of woven cloth.
  uint64_t loops;
  // Width of the cloth, mm.
  double width;
  // Height of the cloth, mm.
  double height;
  // Thickness without load, mm.
  double thickness;
  // Length of all yarn, mm.
  double length;
  // Weight, g/m². NaN unless every material that is used has a tex.
  double areal_weight;
  // Crimp of the warp: length of yarn over length of cloth, less 1. NaN of a knit.
  double warp_crimp;
  // Crimp of the weft.
  double weft_crimp;
  // The share of the cloth's width that ends cover, from 0 to 1. NaN of a knit.
  double warp_cover;
  // The share of the cloth's length that picks cover.
  double weft_cover;
  // The share of the cloth that is covered.
  double cover;
  // Peirce's cover factor of the warp: ends to the inch over the root of the cotton count. NaN
  // of a knit, and unless every material that is used has a tex.
  double warp_cover_factor;
  // Peirce's cover factor of the weft.
  double weft_cover_factor;
  // Peirce's cover factor of the cloth.
  double cover_factor;
  // Length of yarn in a loop, mm. NaN of woven cloth.
  double loop_length;
  // Loops to the square centimetre. NaN of woven cloth.
  double loops_per_cm2;
  // The root of tex over the loop length in cm. NaN of woven cloth, and unless all yarns that
  // are used have one and the same tex.
  double tightness;
} texere_measures;

// Values that lie in the caller's memory: in an array of their own, or as one member of the
// structs of an array. `data` and `stride` are multiples of what the values are aligned to.
typedef struct texere_view {
  // The first value.
  void *data;
  // Bytes from `data` on that belong to the view: at least up to the end of the last value.
  uint64_t size;
  // Bytes from one value to the next: at least the size of a value.
  uint64_t stride;
} texere_view;

// Where a mesh goes: arrays of their own, or members of the caller's structs. No two values
// overlap.
typedef struct texere_mesh_arrays {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Positions, mm: three `float` for each vertex.
  struct texere_view positions;
  // Unit normals, out of the yarn: three `float` for each vertex. Null `data`: left out.
  struct texere_view normals;
  // Indices, a `uint32_t` each. Null `data`: left out.
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
  // The yarn, from 0.
  uint32_t yarn;
  // The ring before the triangle, from the start of the yarn.
  uint32_t ring;
  // The corner of the section before the triangle, from 0; 0 on a cap.
  uint32_t side;
  // A number that begins with TEXERE_CAP.
  uint32_t cap;
  // The control interval of the yarn, from 0: that between this control point and the next.
  uint32_t interval;
  // How far along the interval, from 0 to 1.
  double t;
  // Distance from the start of the ray, in lengths of its direction: mm where that has length 1.
  double distance;
  // The point that is hit, mm.
  double position[3];
} texere_hit;

// What a picture shows, and how. `texere_picture_default` fills it in.
typedef struct texere_picture {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Pixels across.
  uint32_t width;
  // Pixels down.
  uint32_t height;
  // Pixels that are drawn for each pixel of the picture, each way, from 1; each of them has four
  // samples.
  uint32_t supersampling;
  // 1 if fibres that stand off yarns are drawn, else 0.
  uint32_t hairs;
  // A number that begins with TEXERE_BACKGROUND.
  uint32_t background;
  // A colour of the background, sRGB.
  uint8_t color[3];
  // Zero.
  uint8_t reserved;
  // A number that begins with TEXERE_VIEW.
  uint32_t view;
  // 1 if the cloth is turned over sideways, so that its back is seen, else 0.
  uint32_t turned_over;
  // Turn about the cloth's middle, radians, counter-clockwise as seen from above.
  float turn;
  // A point of the cloth, x and y, mm.
  float at[2];
  // What the picture's width shows, mm.
  float width_mm;
  // The eye, mm.
  float eye[3];
  // The point in the middle of the picture, mm.
  float target[3];
  // What is up in the picture, of any length.
  float up[3];
  // From the picture's lower to its upper edge, radians, 0.0001 to 3.1.
  float field_of_view;
  // What the picture's height shows, mm.
  float height_mm;
} texere_picture;

// A chunk of a plan, and where it lies in the mesh.
typedef struct texere_chunk {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // The number of its first vertex in the mesh.
  uint64_t first_vertex;
  // How many vertices it has.
  uint64_t vertex_count;
  // The number of its first index in the mesh.
  uint64_t first_index;
  // How many indices it has. They count from its first vertex.
  uint64_t index_count;
  // Its draws, whose numbers are those of the whole mesh: valid until the plan is freed.
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
  // The place on the yarn's surface, mm; how far it is from the eye follows.
  double position[3];
  // The yarn, from 0.
  uint32_t yarn;
  // 1 where a yarn is seen, else 0.
  uint32_t is_yarn;
} texere_seen;

// Objects that a session works with, as numbers: cast each to the type of its interface.
typedef struct texere_native {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // TEXERE_NATIVE_OPENCL or TEXERE_NATIVE_VULKAN.
  uint32_t kind;
  // The `VkInstance`; 0 with OpenCL.
  uint64_t instance;
  // The `VkPhysicalDevice`; 0 with OpenCL, where the queue says its device.
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
  // The `cl_mem` or `VkBuffer`; 0 where there is none.
  uint64_t buffer;
  // Where the values begin, bytes.
  uint64_t offset;
  // How many bytes the values have.
  uint64_t size;
} texere_device_buffer;

// The mesh of a chunk on its device.
//
// With OpenCL, `ready` is the `cl_event` of the last command that writes the buffers: a command
// that reads them waits for it.
//
// With Vulkan, the commands that write the buffers are in the queue when they are lent. On that
// queue a memory barrier is enough, from writes of compute shaders to what reads. On another queue
// call `texere_session_wait` first. No other thread may call the library with the same device
// while a program submits to its queue. Vertices may be used as a vertex or storage buffer or as
// the source of a transfer, indices as an index or storage buffer or as that source.
typedef struct texere_device_mesh {
  // Bytes of this struct, which the caller sets.
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

// A piece of a mesh: vertices, or indices. All of it is valid until the callback returns, and the
// draws until the plan is freed.
typedef struct texere_piece {
  // Bytes of this struct, which the library sets.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // The chunk that the piece is of, from 0.
  uint64_t chunk;
  // The number of the chunk's first vertex in the mesh: what to add to an index to get the
  // number of a vertex.
  uint64_t base_vertex;
  // The draws of the chunk, whose numbers are those of the whole mesh.
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

// Takes a piece of a mesh. Anything else than 0 ends the call that was given this callback.
typedef int32_t (*texere_piece_callback)(void *user, const struct texere_piece *piece);

// The movement of a guide at one course: from a needle space, in front of the needles, to another.
// Space n lies between the needles n - 1 and n.
typedef struct texere_lap {
  // The needle space before the overlap, 0 to 512.
  int32_t from;
  // The needle space after it, 0 to 512, and two needles away at most. No needle: an inlay.
  int32_t to;
} texere_lap;

// A guide bar.
typedef struct texere_bar {
  // Its chain: laps, course after course from the first one knitted.
  const struct texere_lap *laps;
  // How many laps, 1 to 4096. After the last one the first one follows again.
  uint64_t lap_count;
  // The yarn of each guide, from 0, or TEXERE_NO_YARN. Null and 0: yarn 0 for all.
  const uint32_t *threading;
  // How many guides until the threading begins again.
  uint64_t guide_count;
  // Run-in: length of yarn for a rack of 480 courses, mm; 0 leaves it to the bar.
  double run_in_mm;
  // Needles by which the whole bar is moved towards the high numbers.
  int32_t offset;
  // Zero.
  uint32_t reserved;
} texere_bar;

// A yarn of a knit.
typedef struct texere_knit_yarn {
  // Its diameter, mm; `texere_diameter` gives it for a yarn count.
  double diameter_mm;
  // Twist, radians a mm; positive is Z twist.
  float twist;
  // The number of its material, from 0.
  uint32_t material;
  // The number of its section, from 0.
  uint32_t section;
  // Zero.
  uint32_t reserved;
} texere_knit_yarn;

// The cross-section of yarns. All but a polygon enclose the area of the yarn's circle.
typedef struct texere_section {
  // A number that begins with TEXERE_SECTION.
  uint32_t shape;
  // How many plies or corners.
  uint32_t count;
  // Width over height, 0.05 to 20.
  float aspect;
  // What the shape says.
  float form;
  // Corners of a polygon, counter-clockwise: x and y of each, in radii of the yarn, so that it
  // has two numbers a corner.
  const float *corners;
} texere_section;

// Materials and sections that yarns refer to by their number, from 0.
typedef struct texere_looks {
  // Materials. Null and 0: undyed yarn.
  const struct texere_material *materials;
  // How many materials.
  uint64_t material_count;
  // Sections. Null and 0: a circle.
  const struct texere_section *sections;
  // How many sections.
  uint64_t section_count;
} texere_looks;

// A warp knit as the caller's arrays.
typedef struct texere_warp_knit {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // A number that begins with TEXERE_CELLS.
  uint32_t cells;
  // Wales, a multiple of those after which all bars begin again.
  uint32_t wales;
  // Courses, a multiple of those after which all bars begin again.
  uint32_t courses;
  // Copies of the whole along the courses and along the wales, each from 1.
  uint32_t copies[2];
  // What the design is called, UTF-8.
  const char *name;
  // Bytes of the name.
  size_t name_length;
  // The guide bars, the front one first.
  const struct texere_bar *bars;
  // How many guide bars, 1 to 64.
  uint64_t bar_count;
  // The yarns.
  const struct texere_knit_yarn *yarns;
  // How many yarns.
  uint64_t yarn_count;
  // From one wale to the next, mm.
  double wale_mm;
  // From one course to the next, mm.
  double course_mm;
  // What the yarns refer to.
  struct texere_looks looks;
} texere_warp_knit;

// The stitch in one wale of one course.
typedef struct texere_stitch {
  // A number that begins with TEXERE_STITCH.
  uint32_t kind;
  // Needles to the right, negative to the left, 256 at most, by which the loop moves.
  int32_t moved;
} texere_stitch;

// A weft knit as the caller's arrays: one repeat of stitches, and its copies.
typedef struct texere_weft_knit {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Beds of needles, 1 or 2.
  uint32_t beds;
  // A number that begins with TEXERE_CELLS.
  uint32_t cells;
  // Copies of the repeat along the courses and along the wales, each from 1.
  uint32_t copies[2];
  // Zero.
  uint32_t reserved;
  // What the design is called, UTF-8.
  const char *name;
  // Bytes of the name.
  size_t name_length;
  // Wales of the repeat, 1 to 65536.
  uint64_t wales;
  // Courses of the repeat, 1 to 65536.
  uint64_t courses;
  // The stitches, course after course from the first (the bottom one), each from left to right
  // as seen from the technical face: `wales` times `courses` of them.
  const struct texere_stitch *stitches;
  // The yarn of each course, from 0, in turn from the first course on. Null and 0: yarn 0 for
  // all. Where the turn does not go evenly into the courses, the chart is repeated upwards.
  const uint32_t *turn;
  // How many yarns the turn has.
  uint64_t turn_count;
  // The yarns.
  const struct texere_knit_yarn *yarns;
  // How many yarns.
  uint64_t yarn_count;
  // From one wale to the next, mm.
  double wale_mm;
  // From one course to the next, mm.
  double course_mm;
  // The mean length of yarn in a loop that settling aims for, mm; 0 leaves it to the loops.
  double loop_length_mm;
  // What the yarns refer to.
  struct texere_looks looks;
} texere_weft_knit;

// An end or a pick.
typedef struct texere_thread {
  // Width of its column of the cloth, mm. Two neighbours are half of each spacing apart.
  double spacing_mm;
  // Diameter of the yarn where it is round, mm; `texere_diameter` gives it for a yarn count.
  double diameter_mm;
  // Width over height in the cloth, 0.1 to 10; 0 stands for 1, which is round.
  float flatness;
  // Stiffness against bending, 0.01 to 100, 1 for cotton of its diameter; 0 stands for 1.
  float stiffness;
  // Twist, radians a mm; positive is Z twist.
  float twist;
  // The number of its material, from 0.
  uint32_t material;
  // The number of its section, from 0.
  uint32_t section;
  // Zero.
  uint32_t reserved;
} texere_thread;

// Woven cloth as the caller's arrays.
typedef struct texere_woven {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // A number that begins with TEXERE_SHAPE.
  uint32_t shape;
  // A number that begins with TEXERE_RELIEF.
  uint32_t relief;
  // 1 if the weft turns back round the edge ends, 0 if each pick is cut at both edges.
  uint32_t selvedge;
  // A number that begins with TEXERE_CRIMP.
  uint32_t crimp;
  // The warp's share of the crimp, 0 (straight ends) to 1 (straight picks), with
  // TEXERE_CRIMP_SHARE.
  float warp_share;
  // What the design is called, UTF-8.
  const char *name;
  // Bytes of the name.
  size_t name_length;
  // How many ends.
  uint64_t ends;
  // How many picks.
  uint64_t picks;
  // A row of bits for each pick, which are only read. Row 0 is the first pick, at the bottom of
  // the cloth. Bit 0 (the lowest) of a row's first byte is end 1, at the left; bit 0 of its
  // second byte is end 9. A bit is 1 where the end lies on the face. A row has (`ends` + 7) / 8
  // bytes, and `stride` bytes lie between the beginnings of two rows.
  struct texere_view drawdown;
  // The ends from the left: `ends` of them.
  const struct texere_thread *warp;
  // The picks from the bottom: `picks` of them.
  const struct texere_thread *weft;
  // What the threads refer to.
  struct texere_looks looks;
} texere_woven;

// Takes `size` bytes of a file, which belong at byte `offset` of it. Pieces come in order, but at
// the end a writer may go back to fill in what is known last. Anything else than 0 ends the call
// that was given this callback. `data` is valid until the callback returns.
typedef int32_t (*texere_write_callback)(void *user,
                                         uint64_t offset,
                                         const uint8_t *data,
                                         size_t size);

// Yarns as the caller's arrays.
typedef struct texere_yarn_arrays {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Tension of the splines through the control points, from 0 to below 1; 0 is usual.
  float tension;
  // How many yarns there are.
  uint64_t yarns;
  // Where the points of each yarn begin, and behind them how many points there are in all:
  // `yarns + 1` numbers, the first of which is 0.
  const uint64_t *offsets;
  // The points of all yarns, yarn after yarn.
  const struct texere_point *points;
  // For each yarn 1 if its last point joins up with its first, else 0. Null: all are open.
  const uint8_t *closed;
  // For each yarn its twist, radians a mm; positive is Z twist. Null: none has twist.
  const float *twist;
} texere_yarn_arrays;

// How much yarns hold.
typedef struct texere_yarn_counts {
  // Bytes of this struct, which the caller sets.
  uint32_t struct_size;
  // Tension of their splines.
  float tension;
  // How many yarns there are.
  uint64_t yarns;
  // How many control points they have in all.
  uint64_t points;
} texere_yarn_counts;

// Where on its yarn a vertex lies, for shaders and textures.
typedef struct texere_attribute {
  // The yarn, from 0.
  uint32_t yarn;
  // The angle round the section from its first corner, radians. It turns with the twist.
  float angle;
  // The length of the yarn from its start to the vertex's ring, mm.
  float along;
  // The unit tangent of the yarn there.
  float tangent[3];
} texere_attribute;

// A vertex in half the bytes. docs/CONVENTIONS.md says how it is unpacked.
typedef struct texere_packed_vertex {
  // The position in whole quanta, the lowest 21 bits of each coordinate: x in bits 0 to 20 of
  // these 64, the first word lowest, y in bits 21 to 41, z in bits 42 to 62.
  uint32_t position[2];
  // The normal on an octahedron, in steps of 1/32767.
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
  // Turn of the section about the tangent against the upright frame, in 1/2^32 of a full turn.
  uint32_t roll;
  // Half the height of the yarn, mm.
  float half_height;
  // Growth of the half width along the yarn, mm per mm.
  float width_growth;
  // Growth of the half height along the yarn, mm per mm.
  float height_growth;
  // Turn of the outline of a flattened yarn about the tangent, in 1/2^32 of a full turn.
  uint32_t lean;
} texere_ring;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The number of the binary interface of this library: `TEXERE_ABI` of its header.
uint32_t texere_abi(void);

// The version of this library, such as "0.1.0". The string ends with a zero byte and is valid as
// long as the library is loaded.
const char *texere_version(void);

// Checks a cloth: measures how near its yarns come to one another and how tightly they bend, looks
// for faults, and for single changes of the design that cure them. A mesh with `settings` is
// looked at, too; they may be null: `texere_settings_default` says what holds then. Yarns that
// come short of touching by more than the share `accuracy` pierce: TEXERE_ACCURACY is usual. `run`
// may be null.
//
// A cloth with faults is no failure of the call. It fails with TEXERE_ARGUMENT for settings out of
// range and for an accuracy that is not from 0 to below 1, and with TEXERE_CANCELLED where `run`
// was cancelled.
enum texere_status texere_check_new(const struct texere_cloth *cloth,
                                    const struct texere_settings *settings,
                                    double accuracy,
                                    const struct texere_run *run,
                                    struct texere_check **out);

// Writes what a check has found. The caller has set `diagnosis->struct_size`.
enum texere_status texere_check_diagnosis(const struct texere_check *check,
                                          struct texere_diagnosis *diagnosis);

// Writes the fault of a number, from 0. The caller has set `fault->struct_size`.
//
// Fails with TEXERE_ARGUMENT where there are fewer.
enum texere_status texere_check_fault(const struct texere_check *check,
                                      uint64_t number,
                                      struct texere_fault *fault);

// Writes the warning of a number, from 0, to `words`: UTF-8 that ends with a zero byte, valid
// until the check is freed. A warning is no fault.
//
// Fails with TEXERE_ARGUMENT where there are fewer.
enum texere_status texere_check_warning(const struct texere_check *check,
                                        uint64_t number,
                                        const char **words);

// Lends the faults and their cures as JSON, as `texere check --json` prints them: UTF-8 that ends
// with a zero byte, valid until the check is freed.
enum texere_status texere_check_json(const struct texere_check *check, const char **json);

// Lends the counts and measures of the cloth as JSON, as `texere inspect --json` prints them:
// UTF-8 that ends with a zero byte, valid until the check is freed.
enum texere_status texere_check_measures_json(const struct texere_check *check, const char **json);

// Frees a check, or nothing where it is null.
void texere_check_free(struct texere_check *check);

// Makes the cloth of a design: places its yarns, and lets them come to rest on `device` where the
// design asks for it. `run` may be null.
//
// Where yarns can't come to rest the call succeeds all the same, with the yarns as they are
// placed: `texere_cloth_report` says why. It fails with TEXERE_DESIGN where the cloth can't be
// made, and with TEXERE_CANCELLED where `run` was cancelled.
enum texere_status texere_cloth_rest(const struct texere_design *design,
                                     const struct texere_device *device,
                                     const struct texere_run *run,
                                     struct texere_cloth **out);

// Makes the cloth of a design with its yarns as the structure places them, whatever it asks for.
//
// Fails with TEXERE_DESIGN where the cloth can't be made.
enum texere_status texere_cloth_placed(const struct texere_design *design,
                                       struct texere_cloth **out);

// Writes how the yarns of a cloth came to rest. The caller has set `report->struct_size`.
enum texere_status texere_cloth_report(const struct texere_cloth *cloth,
                                       struct texere_report *report);

// Writes the warning of a number, from 0, to `words`: UTF-8 that ends with a zero byte, valid
// until the cloth is freed.
//
// Fails with TEXERE_ARGUMENT where there are fewer.
enum texere_status texere_cloth_warning(const struct texere_cloth *cloth,
                                        uint64_t number,
                                        const char **words);

// Gives the yarns of a cloth, as a handle of their own. They stay valid when the cloth is freed.
enum texere_status texere_cloth_yarns(const struct texere_cloth *cloth, struct texere_yarns **out);

// Frees a cloth, or nothing where it is null.
void texere_cloth_free(struct texere_cloth *cloth);

// Reads the design in a file: `.wif`, `.toml`, `.k`.
//
// Fails with TEXERE_IO where the file can't be read, and with TEXERE_DESIGN where it is no design;
// `texere_error_place` says where.
enum texere_status texere_design_read(const char *path,
                                      size_t path_length,
                                      struct texere_design **out);

// Reads a design that the caller has in memory. `name` says by its ending what kind of design it
// is; errors call it so. `files` gives the files that the design names; it may be null, and then
// there are none. `user` is handed to it.
//
// Fails as `texere_design_read` does.
enum texere_status texere_design_read_memory(const char *name,
                                             size_t name_length,
                                             const uint8_t *data,
                                             size_t size,
                                             texere_file_callback files,
                                             void *user,
                                             struct texere_design **out);

// Writes woven cloth to a file that `texere_design_read` reads: `.toml` for texere's own design
// file, `.wif` for a WIF 1.1 draft, which leaves out what drafts don't have. A file of that name
// is replaced once the new one is whole.
//
// Fails with TEXERE_UNSUPPORTED for a knit, and with TEXERE_IO where the file can't be written.
enum texere_status texere_design_write(const struct texere_design *design,
                                       const char *path,
                                       size_t path_length);

// Frees a design, or nothing where it is null. Cloths that were made of it stay valid.
void texere_design_free(struct texere_design *design);

// Opens the device of a name: "auto" for the best one, "cpu", "cpu-serial", "opencl", "opencl:1",
// "wgpu" and so on. A `name_length` of 0 is "auto".
//
// Fails with TEXERE_DEVICE where there is none of that name, and with TEXERE_UNSUPPORTED where the
// library was built without it.
enum texere_status texere_device_open(const char *name,
                                      size_t name_length,
                                      struct texere_device **out);

// Writes what a device is. The caller has set `info->struct_size`.
enum texere_status texere_device_describe(const struct texere_device *device,
                                          struct texere_device_info *info);

// Frees a device, or nothing where it is null. What was made with it stays valid.
void texere_device_free(struct texere_device *device);

// Draws a design on squared paper, in a `.png` file: the draft or the point paper of woven cloth,
// the stitch chart of a weft knit, the lapping diagram of a warp knit. `back` is 1 for the cloth
// turned over sideways, else 0. A file of that name is replaced once the new one is whole.
//
// Fails with TEXERE_ARGUMENT for a cloth that is too large to draw, and with TEXERE_IO where the
// file can't be written.
enum texere_status texere_design_draft(const struct texere_design *design,
                                       uint32_t back,
                                       const char *path,
                                       size_t path_length);

// Sets whether the warp is up where an end and a pick cross; both count from 0. Both threads then
// lie as they are woven.
//
// Fails with TEXERE_ARGUMENT where there is no such crossing, where `up` is neither 0 nor 1, and
// in cloth that is not woven or that is known by its yarns alone.
enum texere_status texere_live_set_lift(const struct texere_live *live,
                                        uint64_t end,
                                        uint64_t pick,
                                        uint32_t up);

// Sets many lifts at once: those of `ends` ends from `first_end` on and `picks` picks from
// `first_pick` on. `up` has a byte for each crossing, 1 where the warp is up, else 0: pick after
// pick, and in each the ends in order.
//
// Fails as `texere_live_set_lift` does.
enum texere_status texere_live_set_drawdown(const struct texere_live *live,
                                            uint64_t first_end,
                                            uint64_t ends,
                                            uint64_t first_pick,
                                            uint64_t picks,
                                            const uint8_t *up);

// Writes to `up` 1 if the warp is up where an end and a pick cross, else 0; both count from 0.
//
// Fails as `texere_live_set_lift` does.
enum texere_status texere_live_lift(const struct texere_live *live,
                                    uint64_t end,
                                    uint64_t pick,
                                    uint32_t *up);

// Replaces a yarn, counted from 0: what it is made of and its control points, which may be more or
// fewer than before.
//
// Fails with TEXERE_ARGUMENT for a yarn, material or section that there is not, and for points
// that no yarn can have. The cloth then stays as it was.
enum texere_status texere_live_set_yarn(const struct texere_live *live,
                                        uint64_t yarn,
                                        const struct texere_yarn *what,
                                        const struct texere_point *points,
                                        size_t point_count);

// Gives a yarn, counted from 0, other control points, which may be more or fewer than before.
//
// Fails as `texere_live_set_yarn` does.
enum texere_status texere_live_set_points(const struct texere_live *live,
                                          uint64_t yarn,
                                          const struct texere_point *points,
                                          size_t point_count);

// Writes what a yarn is made of as it is now. Its control points are those of `texere_live_yarns`.
// The caller has set `what->struct_size`.
//
// Fails with TEXERE_ARGUMENT where there is no such yarn.
enum texere_status texere_live_yarn(const struct texere_live *live,
                                    uint64_t yarn,
                                    struct texere_yarn *what);

// Changes a material, counted from 0. A mesh holds no colours, so an update makes nothing again.
//
// Fails with TEXERE_ARGUMENT where there is no such material, and for one that no yarn can have.
enum texere_status texere_live_set_material(const struct texere_live *live,
                                            uint64_t number,
                                            const struct texere_material *material);

// Writes a material as it is now, counted from 0. Its name ends with a zero byte and is valid
// until the next call of this function with this live cloth, or until that is freed.
//
// Fails with TEXERE_ARGUMENT where there is no such material.
enum texere_status texere_live_material(const struct texere_live *live,
                                        uint64_t number,
                                        struct texere_material *material);

// Sets the tension of the splines of all yarns, from 0 to below 1. The whole mesh is made again.
//
// Fails with TEXERE_ARGUMENT for another tension.
enum texere_status texere_live_set_tension(const struct texere_live *live, float tension);

// Replaces the structure by that of a design, such as a knit with another stitch or a weave with
// other threads. Yarns lie as the structure places them. The tension of splines stays. Yarns that
// are the same in both are not made again.
//
// Fails with TEXERE_DESIGN where the yarns of the structure can't be made, and as
// `texere_live_of_cloth` does.
enum texere_status texere_live_set_structure(const struct texere_live *live,
                                             const struct texere_design *design);

// Replaces all yarns. Yarns that are the same in both are not made again. The cloth is known by
// its yarns alone from then on: lifts can't be set.
//
// Fails with TEXERE_ARGUMENT for yarns of another tension, and as `texere_live_of_cloth` does.
enum texere_status texere_live_set_yarns(const struct texere_live *live,
                                         const struct texere_yarns *yarns);

// Replaces all yarns by those of the same cloth at rest, and keeps the weave. Threads whose lifts
// are set later lie as they are woven, among those at rest.
//
// Fails with TEXERE_ARGUMENT for yarns of another tension, and where there are more or fewer yarns
// or sections than the cloth has.
enum texere_status texere_live_set_rest(const struct texere_live *live,
                                        const struct texere_yarns *yarns);

// What went wrong in the last call of this thread that failed, with all its causes, in one line of
// UTF-8 that ends with a zero byte. It is empty where none has failed, and valid until the next
// call of this thread fails.
const char *texere_error_message(void);

// Where in a design's file the last call of this thread that failed has found the fault.
//
// Fails with TEXERE_ARGUMENT for a null `place`.
enum texere_status texere_error_place(struct texere_place *place);

// Writes the finish of a design. The caller has set `finish->struct_size`.
enum texere_status texere_design_finish(const struct texere_design *design,
                                        struct texere_finish *finish);

// Makes a design like another one with a finish of the caller's.
//
// Fails with TEXERE_ARGUMENT for a finish out of range, and for one that the structure does not
// have.
enum texere_status texere_design_finished(const struct texere_design *design,
                                          const struct texere_finish *finish,
                                          struct texere_design **out);

// Makes a live cloth of a cloth, with its mesh on a device. Lifts of a woven cloth can be set.
// `settings` may be null: `texere_settings_default` says what holds then.
//
// Fails with TEXERE_ARGUMENT for settings out of range, with TEXERE_MEMORY where the mesh has no
// room on the device, and with TEXERE_UNSUPPORTED where the device can't keep a mesh.
enum texere_status texere_live_of_cloth(const struct texere_cloth *cloth,
                                        const struct texere_device *device,
                                        const struct texere_settings *settings,
                                        struct texere_live **out);

// Makes a live cloth of yarns, with its mesh on a device. It has no weave, so lifts can't be set.
// `settings` may be null: `texere_settings_default` says what holds then.
//
// Fails as `texere_live_of_cloth` does.
enum texere_status texere_live_of_yarns(const struct texere_yarns *yarns,
                                        const struct texere_device *device,
                                        const struct texere_settings *settings,
                                        struct texere_live **out);

// Makes the parts of the mesh again that edits have changed, and writes which they are. The first
// update makes the whole mesh. `run` may be null. The caller has set `update->struct_size`.
//
// Fails with TEXERE_DEVICE or TEXERE_MEMORY where the device fails, and with TEXERE_CANCELLED where
// `run` was cancelled; the next update makes the same parts.
enum texere_status texere_live_update(const struct texere_live *live,
                                      const struct texere_run *run,
                                      struct texere_update *update);

// Writes the sizes of a live cloth's mesh as of its last update. Vertices and indices count the
// room between yarns, too, in which yarns can become longer. The caller has set
// `counts->struct_size`.
enum texere_status texere_live_counts(const struct texere_live *live, struct texere_counts *counts);

// Lends the draws of a live cloth's mesh as of its last update: `texere_live_counts` says how many
// there are. What lies between them is room, and is not drawn. They are valid until the next
// update, or until the live cloth is freed.
enum texere_status texere_live_draws(const struct texere_live *live,
                                     const struct texere_draw **draws);

// Gives the yarns of a live cloth as they are now, as a handle of their own. They stay as they are
// when the live cloth is edited or freed.
enum texere_status texere_live_yarns(const struct texere_live *live, struct texere_yarns **out);

// Frees a live cloth, or nothing where it is null.
void texere_live_free(struct texere_live *live);

// Reads the whole mesh of a live cloth into the caller's memory. `run` may be null. What the room
// between yarns holds is not said.
//
// Fails with TEXERE_ARGUMENT where `vertex_count` or `index_count` is not what
// `texere_live_counts` says, and where an edit has not been brought to the mesh by
// `texere_live_update`; with TEXERE_CANCELLED where `run` was cancelled.
enum texere_status texere_live_mesh(const struct texere_live *live,
                                    const struct texere_run *run,
                                    struct texere_vertex *vertices,
                                    uint64_t vertex_count,
                                    uint32_t *indices,
                                    uint64_t index_count);

// Reads a stretch of the mesh of a live cloth into the caller's memory, such as a change of the
// last update. Indices count from the base vertex of their draw, as in the whole mesh.
//
// Fails with TEXERE_ARGUMENT where the stretch is no part of the mesh, where `vertex_count` or
// `index_count` is not what it says, and where an edit has not been brought to the mesh by
// `texere_live_update`.
enum texere_status texere_live_read(const struct texere_live *live,
                                    const struct texere_change *change,
                                    struct texere_vertex *vertices,
                                    uint64_t vertex_count,
                                    uint32_t *indices,
                                    uint64_t index_count);

// Writes the diameter, mm, of a yarn of a linear density, tex, and of a density, g/cm³ with the
// air in the yarn: 0.909 is usual for cotton.
//
// Fails with TEXERE_ARGUMENT for numbers that are not above 0 and finite.
enum texere_status texere_diameter(double tex, double density, double *diameter_mm);

// Writes the measures of a cloth. The caller has set `measures->struct_size`.
//
// Fails with TEXERE_DESIGN where they can't be taken.
enum texere_status texere_cloth_measures(const struct texere_cloth *cloth,
                                         struct texere_measures *measures);

// Writes the length of yarn of each material of a cloth, mm: as many as `materials` of
// `texere_cloth_measures` says.
//
// Fails with TEXERE_ARGUMENT where `count` is another number.
enum texere_status texere_cloth_lengths(const struct texere_cloth *cloth,
                                        double *lengths,
                                        uint64_t count);

// Makes the mesh of a plan in the caller's memory, as an array of `texere_vertex` and one of
// indices. `run` may be null.
//
// Fails with TEXERE_ARGUMENT where `vertex_count` or `index_count` is not what
// `texere_plan_counts` says, and with TEXERE_CANCELLED where `run` was cancelled. What the memory
// holds then is not said.
enum texere_status texere_plan_mesh(const struct texere_plan *plan,
                                    const struct texere_run *run,
                                    struct texere_vertex *vertices,
                                    uint64_t vertex_count,
                                    uint32_t *indices,
                                    uint64_t index_count);

// Makes the mesh of a plan in arrays of the caller's choice: positions and normals apart, as
// members of the caller's structs, or one behind the other as in `texere_vertex`. `run` may be
// null. `texere_plan_counts` says how many vertices and indices there are; memory between values
// stays as it is.
//
// Positions and normals that are one behind the other, 24 bytes from vertex to vertex, with
// indices one behind the other, are the fastest: the device writes there without a copy.
//
// Fails with TEXERE_ARGUMENT for a view that is too small, misaligned or null, and with
// TEXERE_CANCELLED where `run` was cancelled. What the memory holds then is not said.
enum texere_status texere_plan_mesh_arrays(const struct texere_plan *plan,
                                           const struct texere_run *run,
                                           const struct texere_mesh_arrays *arrays);

// Makes the packed vertices of a plan in the caller's memory: a `texere_packed_vertex` for each
// vertex that `texere_plan_counts` counts, in the order of the mesh's. `run` may be null.
//
// Fails with TEXERE_ARGUMENT for a view that is too small, misaligned or null, with
// TEXERE_CANCELLED where `run` was cancelled, and with TEXERE_UNSUPPORTED where the device packs
// none.
enum texere_status texere_plan_packed(const struct texere_plan *plan,
                                      const struct texere_run *run,
                                      const struct texere_view *packed);

// Makes the attributes of a plan's vertices in the caller's memory: a `texere_attribute` for each
// vertex that `texere_plan_counts` counts, in the order of the mesh's. `run` may be null.
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

// Makes a picker of yarns. `settings` may be null: `texere_settings_default` says what holds then.
//
// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_MEMORY where memory does
// not suffice.
enum texere_status texere_picker_new(const struct texere_yarns *yarns,
                                     const struct texere_settings *settings,
                                     struct texere_picker **out);

// Writes what a ray hits first, from either side; of several at one distance the first along the
// yarns. A ray that goes nowhere, or whose numbers are not finite, hits nothing.
enum texere_status texere_picker_pick(const struct texere_picker *picker,
                                      const struct texere_ray *ray,
                                      struct texere_hit *hit);

// Writes what a weaver or a knitter calls the place of a hit in a cloth, such as
// `end 3 at pick 4, cotton`. In a weft knit the place in its program follows. The hit is that of a
// picker of the cloth's yarns.
//
// `*length` becomes the length of the text in bytes. The text and a zero byte go to `words`, which
// has room for `size` bytes. Where `size` is 0 only the length is written, and `words` may be
// null.
//
// Fails with TEXERE_ARGUMENT where the cloth has no such place, where its yarn lies elsewhere, as it
// does for a hit of live cloth on a yarn that was edited, and where `size` is neither 0 nor above
// the length.
enum texere_status texere_cloth_place(const struct texere_cloth *cloth,
                                      const struct texere_hit *hit,
                                      char *words,
                                      size_t size,
                                      size_t *length);

// Writes what a ray hits first in a live cloth as it is now; edits count before an update.
//
// Fails with TEXERE_MEMORY where memory does not suffice.
enum texere_status texere_live_pick(const struct texere_live *live,
                                    const struct texere_ray *ray,
                                    struct texere_hit *hit);

// Writes what a weaver or a knitter calls the place of a hit in a live cloth, such as
// `end 3 at pick 4, cotton`: `texere_cloth_place` says how. In yarns that come from no design it
// is the yarn alone.
//
// Fails with TEXERE_ARGUMENT where the live cloth has no such place, and where its yarn lies
// elsewhere now.
enum texere_status texere_live_place(const struct texere_live *live,
                                     const struct texere_hit *hit,
                                     char *words,
                                     size_t size,
                                     size_t *length);

// Frees a picker, or nothing where it is null.
void texere_picker_free(struct texere_picker *picker);

// Writes the usual picture: the whole cloth from above its face, 1600 by 1200 pixels of sixteen
// samples each, with fibres, on the ground. The caller has set `picture->struct_size`.
enum texere_status texere_picture_default(struct texere_picture *picture);

// Plans the mesh of yarns on a device. `settings` may be null: `texere_settings_default` says what
// holds then.
//
// Fails with TEXERE_ARGUMENT for settings out of range.
enum texere_status texere_plan_new(const struct texere_yarns *yarns,
                                   const struct texere_device *device,
                                   const struct texere_settings *settings,
                                   struct texere_plan **out);

// Writes the sizes of a plan's mesh. The caller has set `counts->struct_size`.
enum texere_status texere_plan_counts(const struct texere_plan *plan, struct texere_counts *counts);

// Lends the draws of a plan's mesh: `texere_plan_counts` says how many there are. They are valid
// until the plan is freed.
//
// Fails with TEXERE_ARGUMENT for a null `draws`.
enum texere_status texere_plan_draws(const struct texere_plan *plan,
                                     const struct texere_draw **draws);

// Lends where the rings of each yarn begin, and behind them how many rings there are in all:
// one number more than the plan has yarns, the first of which is 0. They are valid until the plan
// is freed. `count` gets how many numbers there are.
//
// Fails with TEXERE_ARGUMENT for a null `offsets` or `count`.
enum texere_status texere_plan_ring_offsets(const struct texere_plan *plan,
                                            const uint64_t **offsets,
                                            uint64_t *count);

// Writes where a chunk of a plan lies in the mesh. Chunks count from 0; `texere_plan_counts` says
// how many there are. The caller has set `chunk->struct_size`.
//
// Fails with TEXERE_ARGUMENT where there is no chunk of that number.
enum texere_status texere_plan_chunk(const struct texere_plan *plan,
                                     uint64_t number,
                                     struct texere_chunk *chunk);

// Frees a plan, or nothing where it is null.
void texere_plan_free(struct texere_plan *plan);

// Opens a device for pictures: "auto" for the best one, "wgpu", "wgpu:1" and so on. A
// `name_length` of 0 is "auto".
//
// Fails with TEXERE_DEVICE where there is none, and with TEXERE_UNSUPPORTED where the library was
// built without pictures.
enum texere_status texere_renderer_open(const char *name,
                                        size_t name_length,
                                        struct texere_renderer **out);

// Sends yarns to a renderer, which shows them from now on in place of others. `settings` may be
// null: what suits a picture holds then. Their topology and caps have no effect. `run` may be
// null.
//
// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_CANCELLED where `run` was
// cancelled. The renderer then shows nothing.
enum texere_status texere_renderer_show(const struct texere_renderer *renderer,
                                        const struct texere_yarns *yarns,
                                        const struct texere_settings *settings,
                                        const struct texere_run *run);

// Writes the box round the yarns that a renderer shows.
//
// Fails with TEXERE_ARGUMENT where it shows none.
enum texere_status texere_renderer_extent(const struct texere_renderer *renderer,
                                          struct texere_extent *extent);

// Makes a picture in the caller's memory: in each row of `pixels` red, green, blue and alpha of
// each pixel from the left, a byte each, sRGB; rows from the top. `pixels->stride` is the bytes
// from one row to the next, at least four times the width. Alpha is 255 unless the background is
// nothing; colours are not multiplied by it. `run` may be null.
//
// Fails with TEXERE_ARGUMENT where the renderer shows no yarns, for a picture that is out of range
// or larger than the device takes, and for memory that is too small; with TEXERE_CANCELLED where
// `run` was cancelled. The memory is then as it was.
enum texere_status texere_renderer_picture(const struct texere_renderer *renderer,
                                           const struct texere_picture *picture,
                                           const struct texere_run *run,
                                           const struct texere_view *pixels);

// Makes a picture in a `.png` file, with alpha where the background is nothing. `run` may be null.
// A file of that name is replaced once the new one is whole.
//
// Fails as `texere_renderer_picture` does, and with TEXERE_IO where the file can't be written.
enum texere_status texere_renderer_write(const struct texere_renderer *renderer,
                                         const struct texere_picture *picture,
                                         const struct texere_run *run,
                                         const char *path,
                                         size_t path_length);

// Writes what the last picture of a renderer shows at a point, in pixels from its left and upper
// edges. No yarn is seen outside the picture, and before the first one.
//
// Fails with TEXERE_ARGUMENT where the renderer shows no yarns.
enum texere_status texere_renderer_seen(const struct texere_renderer *renderer,
                                        float x,
                                        float y,
                                        struct texere_seen *seen);

// Frees a renderer, or nothing where it is null.
void texere_renderer_free(struct texere_renderer *renderer);

// Makes a run.
//
// Fails with TEXERE_ARGUMENT for a null `out`.
enum texere_status texere_run_new(struct texere_run **out);

// Asks the call that `run` was given to, and every later one, to end with TEXERE_CANCELLED. Any
// thread may ask.
enum texere_status texere_run_cancel(const struct texere_run *run);

// Writes how much of the call is done, from 0 to 1. Any thread may ask.
//
// Fails with TEXERE_ARGUMENT for a null `share`.
enum texere_status texere_run_progress(const struct texere_run *run, double *share);

// Frees a run, or nothing where it is null.
void texere_run_free(struct texere_run *run);

// Starts a session of a plan: sends its control points to the device. `run` may be null. The plan
// may be freed.
//
// Fails with TEXERE_UNSUPPORTED where the device has no buffers to lend, as `cpu` has none, and
// with TEXERE_CANCELLED where `run` was cancelled.
enum texere_status texere_session_new(const struct texere_plan *plan,
                                      const struct texere_run *run,
                                      struct texere_session **out);

// Writes the objects of Vulkan or OpenCL that a session works with, for a program that draws or
// computes with its buffers. They are valid until the session is freed. The caller has set
// `native->struct_size`.
enum texere_status texere_session_native(const struct texere_session *session,
                                         struct texere_native *native);

// Makes the mesh of a chunk on the device, and lends its buffers there: vertices as
// `texere_vertex`, indices that count from the chunk's first vertex. `texere_plan_chunk` says how
// many there are. The call may return before the device is done: `texere_device_mesh` says what to
// wait for. The caller has set `mesh->struct_size`.
//
// The buffers belong to the library, and may be read only. They stay valid until the session is
// freed, and hold this chunk's mesh until the next chunk but one is made.
//
// Fails with TEXERE_ARGUMENT where the plan has no chunk of that number.
enum texere_status texere_session_mesh(const struct texere_session *session,
                                       uint64_t number,
                                       struct texere_device_mesh *mesh);

// Waits until the device has done all that the session has asked of it.
enum texere_status texere_session_wait(const struct texere_session *session);

// Copies the mesh of a chunk that is on the device to the caller's memory. Waits for it.
//
// Fails with TEXERE_ARGUMENT where `vertex_count` or `index_count` is not what `texere_plan_chunk`
// says, and where the chunk was not made or is no longer there.
enum texere_status texere_session_read(const struct texere_session *session,
                                       uint64_t number,
                                       struct texere_vertex *vertices,
                                       uint64_t vertex_count,
                                       uint32_t *indices,
                                       uint64_t index_count);

// Frees a session with its buffers, or nothing where it is null. No command of the program's that
// uses the buffers may be under way.
void texere_session_free(struct texere_session *session);

// Writes the settings that suit yarns: as many subdivisions as their twist needs, as many sides as
// their polygons have. The caller has set `settings->struct_size`.
enum texere_status texere_settings_default(const struct texere_yarns *yarns,
                                           struct texere_settings *settings);

// Makes the mesh of a plan piece by piece, in bounded memory: the control points and two chunks at
// a time. Chunks come in order, each as all its vertices and then all its indices; a piece of
// indices may end within a triangle. With TEXERE_TOPOLOGY_SHARED the pattern of all draws comes
// first, as indices of chunk 0. `run` may be null. `user` is handed to the callback, which runs on
// the calling thread.
//
// Fails with TEXERE_CANCELLED where `run` was cancelled, or where the callback answers other than
// 0.
enum texere_status texere_plan_stream(const struct texere_plan *plan,
                                      const struct texere_run *run,
                                      texere_piece_callback callback,
                                      void *user);

// Makes a design of a warp knit from the caller's arrays, which are copied. Its yarns settle;
// `texere_design_finished` says otherwise.
//
// Fails with TEXERE_ARGUMENT for arrays that no knit can be: the message names array, number from
// 0, value and limit.
enum texere_status texere_design_warp_knit(const struct texere_warp_knit *knit,
                                           struct texere_design **out);

// Makes a design of a weft knit from the caller's arrays, which are copied. Its yarns settle;
// `texere_design_finished` says otherwise.
//
// Fails with TEXERE_ARGUMENT for arrays that no knit can be: the message names array, number from
// 0, value and limit.
enum texere_status texere_design_weft_knit(const struct texere_weft_knit *knit,
                                           struct texere_design **out);

// Makes a design of woven cloth from the caller's arrays, which are copied. Its yarns settle;
// `texere_design_finished` says otherwise.
//
// Fails with TEXERE_ARGUMENT for arrays that no cloth can be: the message names array, number from
// 0, value and limit.
enum texere_status texere_design_woven(const struct texere_woven *woven,
                                       struct texere_design **out);

// Makes the mesh of a plan and writes it to a file, `.glb` or `.ply`, in bounded memory. `run` may
// be null. A file of that name is replaced once the new one is whole.
//
// Fails with TEXERE_IO where the file can't be written, and with TEXERE_CANCELLED where `run` was
// cancelled.
enum texere_status texere_plan_write(const struct texere_plan *plan,
                                     const struct texere_run *run,
                                     const char *path,
                                     size_t path_length);

// Makes the mesh of a plan and hands it as a file to `callback`, in bounded memory: the bytes that
// `texere_plan_write` writes. `format` begins with TEXERE_FORMAT. `run` may be null. `user` is
// handed to the callback, which runs on the calling thread.
//
// Fails with TEXERE_CANCELLED where `run` was cancelled, or where the callback answers other than
// 0. What came before is no whole file.
enum texere_status texere_plan_write_to(const struct texere_plan *plan,
                                        const struct texere_run *run,
                                        uint32_t format,
                                        texere_write_callback callback,
                                        void *user);

// Makes round and flattened yarns of the caller's arrays, which are copied.
//
// Fails with TEXERE_ARGUMENT for arrays that no yarns can be: the message names yarn, point, value
// and limit.
enum texere_status texere_yarns_new(const struct texere_yarn_arrays *arrays,
                                    struct texere_yarns **out);

// Reads yarns that were saved in a `.yarns` file.
//
// Fails with TEXERE_IO where the file can't be read, and with TEXERE_DESIGN where it holds no
// yarns.
enum texere_status texere_yarns_read(const char *path,
                                     size_t path_length,
                                     struct texere_yarns **out);

// Saves yarns in a `.yarns` file, to the bit.
//
// Fails with TEXERE_IO where the file can't be written.
enum texere_status texere_yarns_write(const struct texere_yarns *yarns,
                                      const char *path,
                                      size_t path_length);

// Writes how much yarns hold. The caller has set `counts->struct_size`.
enum texere_status texere_yarns_counts(const struct texere_yarns *yarns,
                                       struct texere_yarn_counts *counts);

// Copies offsets and control points to the caller's memory: `yarns + 1` offsets and `points`
// points, as `texere_yarns_counts` says.
//
// Fails with TEXERE_ARGUMENT where `offset_count` or `point_count` is another number.
enum texere_status texere_yarns_points(const struct texere_yarns *yarns,
                                       uint64_t *offsets,
                                       uint64_t offset_count,
                                       struct texere_point *points,
                                       uint64_t point_count);

// Frees yarns, or nothing where they are null. Plans that were made of them stay valid.
void texere_yarns_free(struct texere_yarns *yarns);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TEXERE_H */
