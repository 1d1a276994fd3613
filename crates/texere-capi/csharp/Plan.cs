// Plans of meshes.

using System;
using System.IO;
using System.Runtime.ExceptionServices;

namespace Texere
{
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

        /// <summary>How many chunks the mesh is made in.</summary>
        public ulong Chunks => counts.chunks;

        /// <summary>Where a chunk, counted from 0, lies in the mesh.</summary>
        public Chunk Chunk(ulong number)
        {
            var found = new texere_chunk { struct_size = (uint)sizeof(texere_chunk) };
            Call.Check(Native.texere_plan_chunk(Own, number, &found), this);
            return new Chunk
            {
                FirstVertex = found.first_vertex,
                VertexCount = found.vertex_count,
                FirstIndex = found.first_index,
                IndexCount = found.index_count,
            };
        }

        /// <summary>Makes the attributes of all vertices in a span, whose length has to be <see cref="Vertices"/>.</summary>
        public void Attributes(Span<VertexAttribute> attributes, Run run = null)
        {
            fixed (VertexAttribute* first = attributes)
            {
                var values = VertexAttribute.View(first, attributes.Length);
                Call.Check(Native.texere_plan_attributes(Own, Run.Of(run), &values), this, run);
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

        /// <summary>
        /// Takes a piece of a mesh: vertices, or indices. The spans are valid until the delegate
        /// returns.
        /// </summary>
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

        /// <summary>
        /// Makes the mesh and writes it to a file, .glb, .ply, .stl, .obj or .usda, in bounded
        /// memory.
        /// </summary>
        public void Write(string path, Run run = null) => Files.Write(
            path, (text, length) => Native.texere_plan_write(Own, Run.Of(run), text, length), this, run);

        /// <summary>Makes the mesh and writes a file to a stream that can seek, in bounded memory.</summary>
        public void Write(MeshFormat format, Stream stream, Run run = null) => Files.Write(
            stream,
            each => Native.texere_plan_write_to(
                Own, Run.Of(run), (uint)format, new Native.texere_plan_write_to_callback_delegate(each), null),
            this, run);

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_plan_free((texere_plan*)handle);
            return true;
        }
    }
}
