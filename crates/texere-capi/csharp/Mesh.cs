// Yarns and their meshes.

using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;

namespace Texere
{
    /// <summary>A control point of a yarn, mm.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Point
    {
        /// <summary>Along the weft or the courses.</summary>
        public float X;
        /// <summary>Along the warp or the wales.</summary>
        public float Y;
        /// <summary>Out of the technical face.</summary>
        public float Z;
        /// <summary>Half the width of the yarn, across the cloth.</summary>
        public float HalfWidth;
        /// <summary>Half the height of the yarn, out of the cloth. In a round yarn it is the half width.</summary>
        public float HalfHeight;
    }

    /// <summary>A vertex of a tube: its position, mm, and its unit normal, which points out of the yarn.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vertex
    {
        /// <summary>The position along the weft or the courses.</summary>
        public float X;
        /// <summary>The position along the warp or the wales.</summary>
        public float Y;
        /// <summary>The position out of the technical face.</summary>
        public float Z;
        /// <summary>The normal along x.</summary>
        public float NormalX;
        /// <summary>The normal along y.</summary>
        public float NormalY;
        /// <summary>The normal along z.</summary>
        public float NormalZ;
    }

    /// <summary>A range of indices that draws a yarn, or a part of one.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Draw
    {
        /// <summary>The number of its first index in the mesh.</summary>
        public ulong FirstIndex;
        /// <summary>How many indices it has: three a triangle, counter-clockwise as seen from outside.</summary>
        public ulong IndexCount;
        /// <summary>What to add to an index to get the number of a vertex.</summary>
        public ulong BaseVertex;
        /// <summary>How many vertices its indices may refer to, from <see cref="BaseVertex"/> on.</summary>
        public ulong VertexCount;
        /// <summary>The yarn, counted from 0.</summary>
        public uint Yarn;
        readonly uint reserved;
    }

    /// <summary>How sections stand along the yarn.</summary>
    public enum Frame : uint
    {
        /// <summary>Upright, with their side at right angles to z. Steep yarns have RotationMinimizing instead.</summary>
        Upright = 0,
        /// <summary>Carried along the yarn without turning about it.</summary>
        RotationMinimizing = 1,
    }

    /// <summary>How triangles name their vertices.</summary>
    public enum Topology : uint
    {
        /// <summary>Three indices for each triangle, counted from the base vertex of their draw.</summary>
        Indexed = 0,
        /// <summary>One pattern of indices that all draws use, counted from the base vertex of each.</summary>
        Shared = 1,
        /// <summary>No indices.</summary>
        None = 2,
    }

    /// <summary>The settings of a mesh. <see cref="Yarns.Settings"/> gives those that suit yarns.</summary>
    public struct Settings
    {
        /// <summary>How many points are inserted between two control points, 0 or more.</summary>
        public uint Subdivisions;
        /// <summary>How many sides the tubes have, 3 or more.</summary>
        public uint Sides;
        /// <summary>How sections stand along the yarn.</summary>
        public Frame Frame;
        /// <summary>How triangles name their vertices.</summary>
        public Topology Topology;
        /// <summary>Whether the ends of yarns are closed.</summary>
        public bool Caps;
        /// <summary>The step of the grid that packed positions lie on, mm: a power of two.</summary>
        public float QuantumMm;

        internal unsafe texere_settings Native => new texere_settings
        {
            struct_size = (uint)sizeof(texere_settings),
            subdivisions = Subdivisions,
            sides = Sides,
            frame = (uint)Frame,
            topology = (uint)Topology,
            caps = Caps ? 1u : 0,
            quantum_mm = QuantumMm,
        };
    }

    /// <summary>Yarns: their control points, sections and materials.</summary>
    public sealed unsafe class Yarns : Handle
    {
        internal Yarns(texere_yarns* made) : base(made) { }

        /// <summary>Makes yarns, round or flattened, of arrays, which are copied.</summary>
        /// <param name="offsets">For each yarn the number of its first point; at the end the number of all points.</param>
        /// <param name="points">The points of all yarns, yarn after yarn.</param>
        /// <param name="closed">For each yarn 1 if its last point joins up with its first; empty if all are open.</param>
        /// <param name="twist">For each yarn its twist, radians per mm, positive for Z; empty if none is twisted.</param>
        /// <param name="tension">Tension of the splines through the points, from 0 to below 1.</param>
        public static Yarns Of(
            ReadOnlySpan<ulong> offsets, ReadOnlySpan<Point> points, ReadOnlySpan<byte> closed = default,
            ReadOnlySpan<float> twist = default, float tension = 0)
        {
            var yarns = Math.Max(offsets.Length - 1, 0);
            var total = offsets.IsEmpty ? 0 : offsets[yarns];
            Needs(nameof(points), points.Length, total);
            if (!closed.IsEmpty) Needs(nameof(closed), closed.Length, (ulong)yarns);
            if (!twist.IsEmpty) Needs(nameof(twist), twist.Length, (ulong)yarns);
            texere_yarns* made;
            fixed (ulong* firstOffset = offsets)
            fixed (Point* firstPoint = points)
            fixed (byte* firstClosed = closed)
            fixed (float* firstTwist = twist)
            {
                var arrays = new texere_yarn_arrays
                {
                    struct_size = (uint)sizeof(texere_yarn_arrays),
                    tension = tension,
                    yarns = (ulong)yarns,
                    offsets = firstOffset,
                    points = (texere_point*)firstPoint,
                    closed = firstClosed,
                    twist = firstTwist,
                };
                Call.Check(Native.texere_yarns_new(&arrays, &made));
            }
            return new Yarns(made);
        }

        static void Needs(string name, int given, ulong needed)
        {
            if ((ulong)given != needed) throw new ArgumentException($"{given} values, and {needed} are needed", name);
        }

        /// <summary>Reads yarns from a .yarns file.</summary>
        public static Yarns Read(string path)
        {
            texere_yarns* made;
            var bytes = Call.Bytes(path);
            fixed (byte* text = bytes) Call.Check(Native.texere_yarns_read(text, (UIntPtr)bytes.Length, &made));
            return new Yarns(made);
        }

        /// <summary>Saves the yarns in a .yarns file, which keeps every bit of them.</summary>
        public void Write(string path)
        {
            var bytes = Call.Bytes(path);
            fixed (byte* text = bytes) Call.Check(Native.texere_yarns_write(Own, text, (UIntPtr)bytes.Length), this);
        }

        internal texere_yarns* Own => (texere_yarns*)Pointer;

        texere_yarn_counts Counts
        {
            get
            {
                var counts = new texere_yarn_counts { struct_size = (uint)sizeof(texere_yarn_counts) };
                Call.Check(Native.texere_yarns_counts(Own, &counts), this);
                return counts;
            }
        }

        /// <summary>How many yarns there are.</summary>
        public ulong Count => Counts.yarns;
        /// <summary>How many control points all yarns have together.</summary>
        public ulong PointCount => Counts.points;
        /// <summary>Tension of the splines through the control points.</summary>
        public float Tension => Counts.tension;

        /// <summary>Copies all control points, and offsets as in <see cref="Of"/>: one more than yarns.</summary>
        public void CopyTo(Span<ulong> offsets, Span<Point> points)
        {
            fixed (ulong* firstOffset = offsets)
            fixed (Point* firstPoint = points)
            {
                Call.Check(Native.texere_yarns_points(
                    Own, firstOffset, (ulong)offsets.Length, (texere_point*)firstPoint, (ulong)points.Length), this);
            }
        }

        /// <summary>The settings that suit the yarns.</summary>
        public Settings Settings
        {
            get
            {
                var usual = new texere_settings { struct_size = (uint)sizeof(texere_settings) };
                Call.Check(Native.texere_settings_default(Own, &usual), this);
                return new Settings
                {
                    Subdivisions = usual.subdivisions,
                    Sides = usual.sides,
                    Frame = (Frame)usual.frame,
                    Topology = (Topology)usual.topology,
                    Caps = usual.caps != 0,
                    QuantumMm = usual.quantum_mm,
                };
            }
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_yarns_free((texere_yarns*)handle);
            return true;
        }
    }

    /// <summary>The plan of a mesh, which has all sizes of the mesh before the mesh is made.</summary>
    public sealed unsafe class Plan : Handle
    {
        readonly texere_counts counts;

        /// <summary>Plans a mesh. Null settings stand for those that suit the yarns.</summary>
        public Plan(Yarns yarns, Device device, Settings? settings = null) : base(Made(yarns, device, settings))
        {
            var found = new texere_counts { struct_size = (uint)sizeof(texere_counts) };
            Call.Check(Native.texere_plan_counts(Own, &found), this);
            counts = found;
        }

        static texere_plan* Made(Yarns yarns, Device device, Settings? settings)
        {
            var given = (settings ?? yarns.Settings).Native;
            texere_plan* made;
            Call.Check(Native.texere_plan_new(yarns.Own, device.Own, &given, &made), yarns, device);
            return made;
        }

        internal texere_plan* Own => (texere_plan*)Pointer;

        /// <summary>How many rings all yarns have together.</summary>
        public ulong Rings => counts.rings;
        /// <summary>How many vertices the mesh has.</summary>
        public ulong Vertices => counts.vertices;
        /// <summary>How many indices the mesh has.</summary>
        public ulong Indices => counts.indices;
        /// <summary>How many triangles the draws draw.</summary>
        public ulong Triangles => counts.triangles;

        /// <summary>The draws, which say which indices draw which yarn. They are valid until Dispose.</summary>
        public ReadOnlySpan<Draw> Draws
        {
            get
            {
                texere_draw* draws;
                Call.Check(Native.texere_plan_draws(Own, &draws), this);
                return new ReadOnlySpan<Draw>(draws, checked((int)counts.draws));
            }
        }

        /// <summary>Makes the mesh in spans as long as <see cref="Vertices"/> and <see cref="Indices"/>.</summary>
        public void Mesh(Span<Vertex> vertices, Span<uint> indices, Run run = null)
        {
            fixed (Vertex* firstVertex = vertices)
            fixed (uint* firstIndex = indices)
            {
                var status = Native.texere_plan_mesh(
                    Own, Run.Of(run), (texere_vertex*)firstVertex, (ulong)vertices.Length, firstIndex,
                    (ulong)indices.Length);
                Call.Check(status, this, run);
            }
        }

        /// <summary>Takes a piece of a mesh: vertices, or indices. The spans are valid until it returns.</summary>
        /// <param name="vertices">Vertices; empty in a piece of indices.</param>
        /// <param name="indices">Indices; empty in a piece of vertices.</param>
        /// <param name="first">The number of the first vertex or index of the piece in the whole mesh.</param>
        /// <param name="baseVertex">With Topology.Indexed, what to add to an index to get the number of a vertex.</param>
        public delegate void Piece(
            ReadOnlySpan<Vertex> vertices, ReadOnlySpan<uint> indices, ulong first, ulong baseVertex);

        /// <summary>Makes the mesh piece by piece. An exception of <paramref name="take"/> ends the call.</summary>
        public void Stream(Piece take, Run run = null)
        {
            ExceptionDispatchInfo thrown = null;
            Native.texere_plan_stream_callback_delegate each = (user, piece) =>
            {
                try
                {
                    var first = piece->vertices != null ? piece->first_vertex : piece->first_index;
                    take(
                        new ReadOnlySpan<Vertex>(piece->vertices, (int)piece->vertex_count),
                        new ReadOnlySpan<uint>(piece->indices, (int)piece->index_count), first, piece->base_vertex);
                    return 0;
                }
                catch (Exception exception)
                {
                    thrown = ExceptionDispatchInfo.Capture(exception);
                    return 1;
                }
            };
            var status = Native.texere_plan_stream(Own, Run.Of(run), each, null);
            thrown?.Throw();
            Call.Check(status, this, run, each);
        }

        /// <summary>Makes the mesh and writes it to a file, .glb or .ply, in bounded memory.</summary>
        public void Write(string path, Run run = null)
        {
            var bytes = Call.Bytes(path);
            fixed (byte* text = bytes)
            {
                var status = Native.texere_plan_write(
                    Own, Run.Of(run), text, (UIntPtr)bytes.Length);
                Call.Check(status, this, run);
            }
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_plan_free((texere_plan*)handle);
            return true;
        }
    }
}
