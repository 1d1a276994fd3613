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

    /// <summary>Properties of a yarn apart from its control points.</summary>
    public struct YarnProperties
    {
        /// <summary>The number of its material, counted from 0.</summary>
        public uint Material;
        /// <summary>The number of its section, counted from 0.</summary>
        public uint Section;
        /// <summary>Whether its last control point joins up with its first.</summary>
        public bool Closed;
        /// <summary>Its twist, radians per mm; positive is Z twist.</summary>
        public float Twist;
    }

    /// <summary>What yarns are made of.</summary>
    public struct Material
    {
        /// <summary>Its name.</summary>
        public string Name;
        /// <summary>Its linear density, tex; 0 if it is not known.</summary>
        public float Tex;
        /// <summary>Length of the fibres that stand off the yarn, cm per cm of yarn, 0 to 30. Only pictures show them.</summary>
        public float Hairiness;
        /// <summary>Red, sRGB.</summary>
        public byte Red;
        /// <summary>Green, sRGB.</summary>
        public byte Green;
        /// <summary>Blue, sRGB.</summary>
        public byte Blue;
    }

    /// <summary>
    /// A cloth that is being edited, with its mesh on a device. One thread at a time may use it. To undo an edit, set
    /// the old value again.
    /// </summary>
    public sealed unsafe class Live : Handle
    {
        /// <summary>Makes a live cloth. Null settings stand for those that suit its yarns.</summary>
        public Live(Cloth cloth, Device device, Settings? settings = null) : base(Made(cloth, device, settings)) { }

        /// <summary>Makes a live cloth of yarns, which have no weave: lifts can't be set.</summary>
        public Live(Yarns yarns, Device device, Settings? settings = null) : base(Made(yarns, device, settings)) { }

        static texere_live* Made(Yarns yarns, Device device, Settings? settings)
        {
            texere_live* made;
            var given = settings.GetValueOrDefault().Native;
            var status = Native.texere_live_of_yarns(
                yarns.Own, device.Own, settings.HasValue ? &given : null, &made);
            Call.Check(status, yarns, device);
            return made;
        }

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

        /// <summary>
        /// Sets many lifts at once: where <paramref name="ends"/> ends, from
        /// <paramref name="firstEnd"/> on, cross picks from <paramref name="firstPick"/> on.
        /// </summary>
        /// <param name="firstEnd">The first end, counted from 0.</param>
        /// <param name="ends">How many ends.</param>
        /// <param name="firstPick">The first pick, counted from 0.</param>
        /// <param name="up">Pick after pick, 1 for each end that is up at the pick, else 0.</param>
        public void SetDrawdown(ulong firstEnd, ulong ends, ulong firstPick, ReadOnlySpan<byte> up)
        {
            var picks = ends == 0 ? 0 : (ulong)up.Length / ends;
            if (picks * ends != (ulong)up.Length) throw new ArgumentException("not a whole number of picks", nameof(up));
            fixed (byte* first = up)
            {
                Call.Check(Native.texere_live_set_drawdown(Own, firstEnd, ends, firstPick, picks, first), this);
            }
        }

        /// <summary>The properties of a yarn, counted from 0, as they are now.</summary>
        public YarnProperties Properties(ulong yarn)
        {
            var found = new texere_yarn { struct_size = (uint)sizeof(texere_yarn) };
            Call.Check(Native.texere_live_yarn(Own, yarn, &found), this);
            return new YarnProperties
            {
                Material = found.material, Section = found.section, Closed = found.closed != 0, Twist = found.twist,
            };
        }

        /// <summary>Replaces a yarn, counted from 0: its properties and its control points.</summary>
        public void SetYarn(ulong yarn, YarnProperties what, ReadOnlySpan<Point> points)
        {
            var given = new texere_yarn
            {
                struct_size = (uint)sizeof(texere_yarn),
                material = what.Material,
                section = what.Section,
                closed = what.Closed ? 1u : 0,
                twist = what.Twist,
            };
            fixed (Point* first = points)
            {
                var status = Native.texere_live_set_yarn(
                    Own, yarn, &given, (texere_point*)first, (UIntPtr)points.Length);
                Call.Check(status, this);
            }
        }

        /// <summary>A material, counted from 0, as it is now.</summary>
        public Material Material(ulong number)
        {
            texere_material found;
            Call.Check(Native.texere_live_material(Own, number, &found), this);
            return new Material
            {
                Name = Copied(found.name),
                Tex = found.tex,
                Hairiness = found.hairiness,
                Red = found.srgb[0],
                Green = found.srgb[1],
                Blue = found.srgb[2],
            };
        }

        /// <summary>Replaces a material, counted from 0.</summary>
        public void SetMaterial(ulong number, Material material)
        {
            var name = Call.Bytes(material.Name ?? "");
            fixed (byte* text = name)
            {
                var given = new texere_material
                {
                    name = text,
                    name_length = (UIntPtr)name.Length,
                    tex = material.Tex,
                    hairiness = material.Hairiness,
                };
                given.srgb[0] = material.Red;
                given.srgb[1] = material.Green;
                given.srgb[2] = material.Blue;
                Call.Check(Native.texere_live_set_material(Own, number, &given), this);
            }
        }

        /// <summary>Sets the tension of the splines of all yarns, from 0 to below 1.</summary>
        public void SetTension(float tension) => Call.Check(Native.texere_live_set_tension(Own, tension), this);

        /// <summary>
        /// Replaces the structure by that of a design. The yarns lie as the new structure places
        /// them.
        /// </summary>
        public void SetStructure(Design design) =>
            Call.Check(Native.texere_live_set_structure(Own, design.Own), this, design);

        /// <summary>Replaces all yarns. From then on there is no weave, so lifts can't be set.</summary>
        public void SetYarns(Yarns yarns) => Call.Check(Native.texere_live_set_yarns(Own, yarns.Own), this, yarns);

        /// <summary>Replaces all yarns by those of the same cloth at rest, and keeps the weave.</summary>
        public void SetRest(Yarns yarns) => Call.Check(Native.texere_live_set_rest(Own, yarns.Own), this, yarns);

        /// <summary>
        /// Makes attributes as well as the mesh, from the next update on. That update makes the
        /// whole mesh again.
        /// </summary>
        public void KeepAttributes() => Call.Check(Native.texere_live_keep_attributes(Own), this);

        /// <summary>Reads the attributes of all vertices.</summary>
        public void Attributes(Span<VertexAttribute> attributes, Run run = null)
        {
            fixed (VertexAttribute* first = attributes)
            {
                var values = VertexAttribute.View(first, attributes.Length);
                Call.Check(Native.texere_live_attributes(Own, Run.Of(run), &values), this, run);
            }
        }

        /// <summary>Reads the attributes of the vertices of a change.</summary>
        public void Attributes(Change change, Span<VertexAttribute> attributes)
        {
            fixed (VertexAttribute* first = attributes)
            {
                var values = VertexAttribute.View(first, attributes.Length);
                Call.Check(Native.texere_live_read_attributes(Own, (texere_change*)&change, &values), this);
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
        /// <param name="anew">Whether a new mesh was made, so that sizes and draws may have changed.</param>
        /// <param name="run">Gets the progress, and can cancel the call.</param>
        /// <returns>The ranges that were made again. They are valid until the next update.</returns>
        public ReadOnlySpan<Change> Update(out bool anew, Run run = null)
        {
            var update = new texere_update { struct_size = (uint)sizeof(texere_update) };
            Call.Check(Native.texere_live_update(Own, Run.Of(run), &update), this, run);
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

        /// <summary>
        /// Reads a change. The spans have to be as long as the change's numbers of vertices and
        /// indices.
        /// </summary>
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
