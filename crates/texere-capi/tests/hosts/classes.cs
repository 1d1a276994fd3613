// Tests the classes for C# against one another: files in streams, every edit of live cloth, pictures, a session.
using System;
using System.IO;
using System.Runtime.InteropServices;
using System.Text;
using Texere;

static unsafe class Classes
{
    const string Plain = "weave = { notation = \"plain\", ends = 6, picks = 6 }\nfinish.settle = false\n"
        + "yarns.a.diameter_mm = 0.2\nwarp = { yarns = [\"a\"], spacing_mm = 0.5 }\n"
        + "weft = { yarns = [\"a\"], spacing_mm = 0.5 }\n";

    static void Check(bool holds, string what)
    {
        if (!holds) throw new Exception(what);
    }

    static TError Thrown<TError>(Action call) where TError : Exception
    {
        try
        {
            call();
        }
        catch (TError error)
        {
            return error;
        }
        throw new Exception("nothing was thrown");
    }

    static byte[] Bytes(Action<Stream> write)
    {
        using (var stream = new MemoryStream())
        {
            write(stream);
            Check(stream.Position == stream.Length && stream.Length > 0, "the stream stands at its end");
            return stream.ToArray();
        }
    }

    static byte[] Saved(Yarns yarns) => Bytes(stream => yarns.Write(YarnsFormat.Yarns, stream));

    static byte[] Saved(Live live)
    {
        using (var yarns = live.Yarns) return Saved(yarns);
    }

    static bool Same(byte[] one, byte[] other) => one.AsSpan().SequenceEqual(other);

    static void Main(string[] arguments)
    {
        Check(sizeof(NativeObjects) == sizeof(texere_native), "NativeObjects");
        Check(sizeof(DeviceMesh) == sizeof(texere_device_mesh), "DeviceMesh");
        Check(sizeof(DeviceBuffer) == sizeof(texere_device_buffer), "DeviceBuffer");
        Check(sizeof(VertexAttribute) == sizeof(texere_attribute), "VertexAttribute");
        Check((uint)NativeKind.Vulkan == Native.TEXERE_NATIVE_VULKAN, "NativeKind");
        Check((uint)View.Parallel == Native.TEXERE_VIEW_PARALLEL, "View");
        Check((uint)Background.Nothing == Native.TEXERE_BACKGROUND_NOTHING, "Background");
        Check((uint)DesignFormat.Wif == Native.TEXERE_DESIGN_FORMAT_WIF, "DesignFormat");
        Check((uint)DesignFormat.Knitout == Native.TEXERE_DESIGN_FORMAT_KNITOUT, "DesignFormat");
        Check((uint)MeshFormat.Ply == Native.TEXERE_FORMAT_PLY, "MeshFormat");
        Check((uint)MeshFormat.Stl == Native.TEXERE_FORMAT_STL, "MeshFormat");
        Check((uint)MeshFormat.Obj == Native.TEXERE_FORMAT_OBJ, "MeshFormat");
        Check((uint)MeshFormat.PackedGlb == Native.TEXERE_FORMAT_PACKED_GLB, "MeshFormat");
        Check((uint)MeshFormat.CompressedGlb == Native.TEXERE_FORMAT_COMPRESSED_GLB, "MeshFormat");
        Check((uint)MeshFormat.InstancedGlb == Native.TEXERE_FORMAT_INSTANCED_GLB, "MeshFormat");
        Check((uint)MeshFormat.Usda == Native.TEXERE_FORMAT_USDA, "MeshFormat");
        Check((uint)MeshFormat.KhrCompressedGlb == Native.TEXERE_FORMAT_KHR_COMPRESSED_GLB, "MeshFormat");
        Check((uint)YarnsFormat.Usda == Native.TEXERE_YARNS_FORMAT_USDA, "YarnsFormat");
        Check((uint)YarnsFormat.LinearUsda == Native.TEXERE_YARNS_FORMAT_LINEAR_USDA, "YarnsFormat");
        using (var design = Design.Read("plain.toml", Encoding.UTF8.GetBytes(Plain)))
        using (var cloth = Cloth.Placed(design))
        using (var device = new Device("cpu"))
        {
            Streams(design, cloth, device);
            Edits(design, cloth, device);
            Pictures(cloth);
            foreach (var name in arguments) LentMesh(cloth, name);
        }
    }

    static void Streams(Design design, Cloth cloth, Device device)
    {
        var wif = Encoding.UTF8.GetString(Bytes(stream => design.Write(DesignFormat.Wif, stream)));
        Check(wif.Contains("[THREADING]"), wif);
        var toml = Bytes(stream => design.Write(DesignFormat.Toml, stream));
        Check(Bytes(stream => design.Draft(stream))[1] == 'P', "PNG");
        var (folder, name) = (Path.GetTempPath(), Path.GetRandomFileName());
        foreach (var ending in new[] { ".toml", ".png", ".usda", ".glb" })
        {
            var path = Path.Combine(folder, name + ending);
            using (var yarns = cloth.Yarns)
            using (var plan = new Plan(yarns, device))
            {
                Action<Stream> write = null;
                switch (ending)
                {
                    case ".toml":
                        design.Write(path);
                        write = stream => design.Write(DesignFormat.Toml, stream);
                        break;
                    case ".png":
                        design.Draft(path, true);
                        write = stream => design.Draft(stream, true);
                        break;
                    case ".usda":
                        yarns.Write(path);
                        write = stream => yarns.Write(YarnsFormat.Usda, stream);
                        break;
                    default:
                        plan.Write(path);
                        write = stream => plan.Write(MeshFormat.Glb, stream);
                        break;
                }
                Check(Same(File.ReadAllBytes(path), Bytes(write)), ending);
            }
            File.Delete(path);
        }
        using (var again = Design.Read("again.toml", toml))
        using (var other = Cloth.Placed(again))
        using (var yarns = cloth.Yarns)
        using (var own = other.Yarns)
        {
            var saved = Saved(yarns);
            Check(Same(Saved(own), saved), "a design that was written and read");
            using (var read = Yarns.Read("saved.yarns", saved)) Check(Same(Saved(read), saved), "yarns of memory");
            var cut = Thrown<TexereException>(() => Yarns.Read("saved.yarns", saved.AsSpan(1)));
            Check(cut.Status == Status.Design && cut.File == "saved.yarns", cut.Message);
        }
        // A stream that can't be written to ends the call with its own exception.
        var closed = new MemoryStream(new byte[1], false);
        Thrown<NotSupportedException>(() => design.Write(DesignFormat.Wif, closed));
    }

    // Makes an edit and undoes the edit. The edit has to change the yarns, and undoing it has to
    // bring them back.
    static void Edited(Live live, Action edit, Action undo)
    {
        var before = Saved(live);
        edit();
        Check(!Same(Saved(live), before), "an edit");
        live.Update(out _);
        undo();
        Check(Same(Saved(live), before), "an edit that is undone");
    }

    static void Edits(Design design, Cloth cloth, Device device)
    {
        using (var yarns = cloth.Yarns)
        using (var live = new Live(cloth, device))
        using (var other = new Live(cloth, device))
        {
            live.Update(out _);
            var (offsets, points) = (new ulong[yarns.Count + 1], new Point[yarns.PointCount]);
            yarns.CopyTo(offsets, points);
            var own = points.AsSpan(0, (int)offsets[1]).ToArray();
            var bent = (Point[])own.Clone();
            bent[1].Z += .1f;
            var what = live.Properties(0);
            var twisted = what;
            twisted.Twist = .5f;
            Edited(live, () => live.SetPoints(0, bent), () => live.SetPoints(0, own));
            Edited(live, () => live.SetYarn(0, twisted, own), () => live.SetYarn(0, what, own));
            Edited(live, () => live.SetTension(.3f), () => live.SetTension(0));
            var material = live.Material(0);
            Check(material.Name == "a", material.Name);
            var red = material;
            red.Name = "garance d'été";
            red.Red ^= 0x40;
            Edited(live, () => live.SetMaterial(0, red), () => live.SetMaterial(0, material));
            live.SetMaterial(0, red);
            Check(live.Material(0).Name == red.Name && live.Material(0).Red == red.Red, "material");
            live.SetMaterial(0, material);

            // Lifts one by one, and as a block of 2 ends and 3 picks.
            var block = new byte[6];
            for (var at = 0; at < block.Length; at++)
            {
                var (end, pick) = (2 + (ulong)at % 2, 1 + (ulong)at / 2);
                block[at] = (byte)(live[end, pick] ? 0 : 1);
                other[end, pick] = block[at] == 1;
            }
            live.SetDrawdown(2, 2, 1, block);
            Check(Same(Saved(live), Saved(other)) && !Same(Saved(live), Saved(yarns)), "lifts");
            Thrown<ArgumentException>(() => live.SetDrawdown(2, 2, 1, block.AsSpan(1)));
            live.SetRest(yarns);
            Check(Same(Saved(live), Saved(yarns)), "yarns at rest");
            live.SetStructure(design);
            Check(live[2, 1] != other[2, 1], "structure");
            using (var edited = other.Yarns) live.SetYarns(edited);
            Check(Same(Saved(live), Saved(other)), "all yarns");
            var refused = Thrown<TexereException>(() => live[0, 0] = true);
            Check(refused.Status == Status.Argument, refused.Message);

            using (var given = new Live(yarns, device))
            using (var plan = new Plan(yarns, device))
            using (var run = new Run())
            {
                given.KeepAttributes();
                var changes = given.Update(out _);
                var last = changes[changes.Length - 1];
                var all = new VertexAttribute[given.Vertices];
                given.Attributes(all);
                var part = new VertexAttribute[last.VertexCount];
                given.Attributes(last, part);
                var same = MemoryMarshal.AsBytes<VertexAttribute>(part).SequenceEqual(
                    MemoryMarshal.AsBytes(all.AsSpan((int)last.FirstVertex, part.Length)));
                Check(same, "attributes of a change");
                var planned = new VertexAttribute[plan.Vertices];
                plan.Attributes(planned);
                Check(planned[planned.Length - 1].Yarn == yarns.Count - 1, "attributes of a plan");
                run.Cancel();
                given.SetTension(.2f);
                var cancelled = Thrown<TexereException>(() => given.Update(out _, run));
                Check(cancelled.Status == Status.Cancelled, cancelled.Message);
            }
        }
    }

    static void Pictures(Cloth cloth)
    {
        using (var yarns = cloth.Yarns)
        using (var renderer = new Renderer())
        {
            Check(Thrown<TexereException>(() => renderer.Seen(1, 1)).Status == Status.Argument, "no yarns");
            renderer.Show(yarns, yarns.Settings);
            var (low, high) = renderer.Extent;
            Check(low.X <= 0 && high.X >= 3 && high.Z > low.Z, "extent");
            var picture = Picture.Usual(40, 30);
            var usual = renderer.Picture(40, 30);
            var pixels = new byte[usual.Length];
            renderer.Picture(picture, pixels);
            Check(Same(usual, pixels), "the usual picture");
            var seen = renderer.Seen(22, 13);
            Check(seen.HasValue && seen.Value.Yarn < yarns.Count && seen.Value.X > 1 && seen.Value.X < 2, "seen");
            Check(renderer.Seen(-1, 15) == null, "nothing is seen");
            (picture.Background, picture.Red, picture.Green, picture.Blue) = (Background.Color, 1, 2, 3);
            (picture.View, picture.FieldOfView) = (View.Eye, .5f);
            picture.Eye = new Vector(1.5f, 1.5f, 30);
            picture.Target = new Vector(1.5f, 1.5f, 0);
            picture.Up = new Vector(0, 1, 0);
            renderer.Picture(picture, pixels);
            Check(pixels[0] == 1 && pixels[1] == 2 && pixels[2] == 3 && pixels[3] == 255, "background");
            Check(!pixels.AsSpan((15 * 40 + 20) * 4, 4).SequenceEqual(pixels.AsSpan(0, 4)), "yarns");
            picture.Background = Background.Nothing;
            renderer.Picture(picture, pixels);
            Check(pixels[3] == 0, "alpha");
            var path = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName() + ".png");
            renderer.Write(picture, path);
            Check(Same(File.ReadAllBytes(path), Bytes(stream => renderer.Write(picture, stream))), "file");
            File.Delete(path);
            var small = Thrown<TexereException>(() => renderer.Picture(Picture.Usual(40, 30), new byte[7]));
            Check(small.Status == Status.Argument, small.Message);
        }
    }

    // A chunk that stays on a device has the mesh of its plan.
    static void LentMesh(Cloth cloth, string name)
    {
        using (var yarns = cloth.Yarns)
        using (var device = new Device(name))
        using (var plan = new Plan(yarns, device))
        using (var session = new Session(plan))
        {
            var chunk = plan.Chunk(0);
            Check(plan.Chunks == 1 && chunk.VertexCount == plan.Vertices, "chunk");
            var (vertices, indices) = (new Vertex[plan.Vertices], new uint[plan.Indices]);
            plan.Mesh(vertices, indices);
            var mesh = session.Mesh(0);
            Check(session.Objects.Device != 0 && session.Objects.Kind == mesh.Kind, "objects");
            Check(mesh.Vertices.Buffer != 0 && mesh.Vertices.Size == plan.Vertices * 24, "buffer");
            session.Wait();
            var (lent, own) = (new Vertex[plan.Vertices], new uint[plan.Indices]);
            session.Read(0, lent, own);
            Check(MemoryMarshal.AsBytes<Vertex>(lent).SequenceEqual(MemoryMarshal.AsBytes<Vertex>(vertices)), "lent");
            Check(own.AsSpan().SequenceEqual(indices), "lent indices");
            Check(Thrown<TexereException>(() => session.Mesh(1)).Status == Status.Argument, "no chunk");
        }
    }
}
