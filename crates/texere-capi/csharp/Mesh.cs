// Yarns and their meshes.

using System;
using System.IO;
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

    /// <summary>Where on its yarn a vertex lies.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct VertexAttribute
    {
        /// <summary>The yarn, counted from 0.</summary>
        public uint Yarn;
        /// <summary>The angle round the section from its first corner, radians.</summary>
        public float Angle;
        /// <summary>The length of the yarn from its start to the vertex's ring, mm.</summary>
        public float Along;
        /// <summary>The unit tangent of the yarn along the weft or the courses.</summary>
        public float TangentX;
        /// <summary>The tangent along the warp or the wales.</summary>
        public float TangentY;
        /// <summary>The tangent out of the technical face.</summary>
        public float TangentZ;

        internal static texere_view View(VertexAttribute* first, int count) => new texere_view
        {
            data = first,
            size = (ulong)count * (ulong)sizeof(VertexAttribute),
            stride = (ulong)sizeof(VertexAttribute),
        };
    }

    /// <summary>A chunk of a mesh, and where it lies in the whole mesh.</summary>
    public struct Chunk
    {
        /// <summary>The number of its first vertex.</summary>
        public ulong FirstVertex;
        /// <summary>How many vertices it has.</summary>
        public ulong VertexCount;
        /// <summary>The number of its first index.</summary>
        public ulong FirstIndex;
        /// <summary>How many indices it has. They count from its first vertex.</summary>
        public ulong IndexCount;
    }

    /// <summary>How sections stand along the yarn.</summary>
    public enum Frame : uint
    {
        /// <summary>
        /// Upright, with their width at right angles to z. A round yarn that runs too steeply for
        /// that has RotationMinimizing instead. A flattened yarn that runs so steeply leans.
        /// </summary>
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
        /// <summary>How many points are inserted between two control points, 0 to 1023.</summary>
        public uint Subdivisions;
        /// <summary>How many sides the tubes have, 3 to 256.</summary>
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

        /// <summary>Reads yarns from the bytes of a .yarns file.</summary>
        /// <param name="name">What errors call the file.</param>
        /// <param name="data">The contents of the file.</param>
        public static Yarns Read(string name, ReadOnlySpan<byte> data)
        {
            texere_yarns* made;
            var bytes = Call.Bytes(name);
            fixed (byte* text = bytes, first = data)
            {
                Call.Check(Native.texere_yarns_read_memory(
                    text, (UIntPtr)bytes.Length, first, (UIntPtr)data.Length, &made));
            }
            return new Yarns(made);
        }

        /// <summary>Reads curves that another program wrote: .bcc, .obj, .usda or .tg3.</summary>
        /// <param name="path">The file.</param>
        /// <param name="unitMm">
        /// The length of the file's unit, mm. With 0 it is what a .usda or .tg3 file says, and 1 mm
        /// in a .bcc or .obj file.
        /// </param>
        /// <param name="diameterMm">
        /// The diameter of all yarns, mm. With 0 a .usda or .tg3 file says the widths. A .bcc or
        /// .obj file needs a diameter.
        /// </param>
        public static Yarns ReadCurves(string path, float unitMm = 0, float diameterMm = 0)
        {
            texere_yarns* made;
            var bytes = Call.Bytes(path);
            fixed (byte* text = bytes)
            {
                Call.Check(Native.texere_yarns_read_curves(
                    text, (UIntPtr)bytes.Length, unitMm, diameterMm, &made));
            }
            return new Yarns(made);
        }

        /// <summary>Writes the yarns to a file: .yarns, which keeps every bit of them, .bcc or .usda.</summary>
        public void Write(string path) =>
            Files.Write(path, (text, length) => Native.texere_yarns_write(Own, text, length), this);

        /// <summary>Writes the yarns to a stream.</summary>
        public void Write(YarnsFormat format, Stream stream) => Files.Write(
            stream,
            each => Native.texere_yarns_write_to(
                Own, (uint)format, new Native.texere_yarns_write_to_callback_delegate(each), null),
            this);

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
}
