// Cloth that is edited while its mesh stays on a device.

using System;
using System.Runtime.InteropServices;

namespace Texere
{
    /// <summary>A range of vertices and a range of indices that an update has made again.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Change
    {
        /// <summary>The number of the first vertex in the whole mesh.</summary>
        public ulong FirstVertex;
        /// <summary>How many vertices there are.</summary>
        public ulong VertexCount;
        /// <summary>The number of the first index in the whole mesh.</summary>
        public ulong FirstIndex;
        /// <summary>How many indices there are.</summary>
        public ulong IndexCount;
    }

    /// <summary>
    /// A cloth that is being edited, with its mesh on a device. One thread at a time may use it. To undo an edit, set
    /// the old value again.
    /// </summary>
    public sealed unsafe class Live : Handle
    {
        /// <summary>Makes a live cloth. Null settings stand for those that suit its yarns.</summary>
        public Live(Cloth cloth, Device device, Settings? settings = null) : base(Made(cloth, device, settings)) { }

        static texere_live* Made(Cloth cloth, Device device, Settings? settings)
        {
            texere_live* made;
            var given = settings.GetValueOrDefault().Native;
            var status = Native.texere_live_of_cloth(
                cloth.Own, device.Own, settings.HasValue ? &given : null, &made);
            Call.Check(status, cloth, device);
            return made;
        }

        texere_live* Own => (texere_live*)Pointer;

        texere_counts Counts
        {
            get
            {
                var counts = new texere_counts { struct_size = (uint)sizeof(texere_counts) };
                Call.Check(Native.texere_live_counts(Own, &counts), this);
                return counts;
            }
        }

        /// <summary>How many vertices the mesh had at the last update, with the room between yarns.</summary>
        public ulong Vertices => Counts.vertices;
        /// <summary>How many indices the mesh had at the last update, with the room between yarns.</summary>
        public ulong Indices => Counts.indices;

        /// <summary>Whether the warp is up where an end and a pick cross. Ends and picks count from 0.</summary>
        public bool this[ulong end, ulong pick]
        {
            get
            {
                uint up;
                Call.Check(Native.texere_live_lift(Own, end, pick, &up), this);
                return up != 0;
            }
            set => Call.Check(Native.texere_live_set_lift(Own, end, pick, value ? 1u : 0), this);
        }

        /// <summary>Gives a yarn, counted from 0, other control points. There may be more or fewer than before.</summary>
        public void SetPoints(ulong yarn, ReadOnlySpan<Point> points)
        {
            fixed (Point* first = points)
            {
                var status = Native.texere_live_set_points(
                    Own, yarn, (texere_point*)first, (UIntPtr)points.Length);
                Call.Check(status, this);
            }
        }

        /// <summary>The draws, which say which indices draw which yarn. They are valid until the next update.</summary>
        public ReadOnlySpan<Draw> Draws
        {
            get
            {
                texere_draw* draws;
                Call.Check(Native.texere_live_draws(Own, &draws), this);
                return new ReadOnlySpan<Draw>(draws, checked((int)Counts.draws));
            }
        }

        /// <summary>Brings the edits to the mesh.</summary>
        /// <param name="anew">Whether the whole mesh was begun anew, so that sizes and draws may have changed.</param>
        /// <returns>The ranges that were made again. They are valid until the next update.</returns>
        public ReadOnlySpan<Change> Update(out bool anew)
        {
            var update = new texere_update { struct_size = (uint)sizeof(texere_update) };
            Call.Check(Native.texere_live_update(Own, null, &update), this);
            anew = update.anew != 0;
            return new ReadOnlySpan<Change>(update.changes, checked((int)update.change_count));
        }

        /// <summary>Reads the mesh into spans as long as <see cref="Vertices"/> and <see cref="Indices"/>.</summary>
        public void Mesh(Span<Vertex> vertices, Span<uint> indices, Run run = null)
        {
            fixed (Vertex* firstVertex = vertices)
            fixed (uint* firstIndex = indices)
            {
                var status = Native.texere_live_mesh(
                    Own, Run.Of(run), (texere_vertex*)firstVertex, (ulong)vertices.Length, firstIndex,
                    (ulong)indices.Length);
                Call.Check(status, this, run);
            }
        }

        /// <summary>Reads a change into spans that have as many vertices and indices as it.</summary>
        public void Read(Change change, Span<Vertex> vertices, Span<uint> indices)
        {
            fixed (Vertex* firstVertex = vertices)
            fixed (uint* firstIndex = indices)
            {
                var status = Native.texere_live_read(
                    Own, (texere_change*)&change, (texere_vertex*)firstVertex, (ulong)vertices.Length, firstIndex,
                    (ulong)indices.Length);
                Call.Check(status, this);
            }
        }

        /// <summary>A copy of the yarns as they are now. Later edits do not change it.</summary>
        public Yarns Yarns
        {
            get
            {
                texere_yarns* made;
                Call.Check(Native.texere_live_yarns(Own, &made), this);
                return new Yarns(made);
            }
        }

        /// <summary>What a ray hits first, or null if it hits nothing. Edits count even before an update.</summary>
        public Hit? Pick(Ray ray)
        {
            Hit hit;
            Call.Check(Native.texere_live_pick(Own, (texere_ray*)&ray, (texere_hit*)&hit), this);
            return hit.Found ? hit : default(Hit?);
        }

        /// <summary>What a weaver or a knitter calls the place of a hit.</summary>
        public string Place(Hit hit) => Call.Written(
            (words, size, length) =>
            {
                var place = hit;
                return Native.texere_live_place(Own, (texere_hit*)&place, words, size, length);
            }, this);

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_live_free((texere_live*)handle);
            return true;
        }
    }
}
