// Tests what the classes for C# add to the calls: exceptions, disposal, and structs laid out like the library's.
using System;
using System.Runtime.InteropServices;
using System.Text;
using Texere;

static unsafe class Wrappers
{
    static void Check(bool holds, string what)
    {
        if (!holds) throw new Exception(what);
    }

    static TexereException Thrown(Action call)
    {
        try
        {
            call();
        }
        catch (TexereException error)
        {
            return error;
        }
        throw new Exception("nothing was thrown");
    }

    static void Main()
    {
        Check(sizeof(Point) == sizeof(texere_point), "Point");
        Check(sizeof(Vertex) == sizeof(texere_vertex), "Vertex");
        Check(sizeof(Draw) == sizeof(texere_draw), "Draw");
        Check(sizeof(Change) == sizeof(texere_change), "Change");
        Check(sizeof(Ray) == sizeof(texere_ray), "Ray");
        Check(sizeof(Hit) == sizeof(texere_hit), "Hit");
        Check((uint)Cap.Finish == Native.TEXERE_CAP_FINISH, "Cap");
        foreach (texere_status status in Enum.GetValues(typeof(texere_status)))
        {
            var known = status == texere_status.TEXERE_OK || Enum.IsDefined(typeof(Status), (int)status);
            Check(known, $"{status} is no Status");
        }
        Check((uint)Outcome.Refused == Native.TEXERE_REFUSED, "Outcome");
        Check((uint)Frame.RotationMinimizing == Native.TEXERE_FRAME_ROTATION_MINIMIZING, "Frame");
        Check((uint)Topology.None == Native.TEXERE_TOPOLOGY_NONE, "Topology");

        var wrong = "weave = { notation = \"plain\", ends = 4, picks = 4 }\nyarns.a.tex = -3\n";
        var refused = Thrown(() => Design.Read("wrong.toml", Encoding.UTF8.GetBytes(wrong)));
        Check(refused.Status == Status.Design && refused.File == "wrong.toml" && refused.Line == 2, "place");
        Check(refused.Message.Contains("yarns.a.tex"), refused.Message);

        var device = new Device("cpu");
        Check(device.Name == "cpu", device.Name);
        var points = new[] { At(0), At(1), At(2) };
        using (var yarns = Yarns.Of(new ulong[] { 0, 3 }, points))
        using (var plan = new Plan(yarns, device))
        using (var run = new Run())
        {
            var (offsets, copied) = (new ulong[2], new Point[yarns.PointCount]);
            yarns.CopyTo(offsets, copied);
            Check(offsets[1] == 3 && copied[2].X == 2 && yarns.Count == 1, "points");
            var small = Thrown(() => plan.Mesh(new Vertex[1], new uint[1]));
            Check(small.Status == Status.Argument && small.File == null, "sizes");
            var (vertices, indices) = (new Vertex[plan.Vertices], new uint[plan.Indices]);
            plan.Mesh(vertices, indices);
            var taken = 0;
            plan.Stream((piece, corners, first, baseVertex) =>
            {
                foreach (var vertex in piece) Check(vertex.Y == vertices[taken++].Y, "piece");
            });
            Check(taken == vertices.Length, "pieces");
            try
            {
                plan.Stream((piece, corners, first, baseVertex) => throw new InvalidOperationException());
                Check(false, "nothing was thrown");
            }
            catch (InvalidOperationException)
            {
            }
            run.Cancel();
            Check(Thrown(() => plan.Mesh(vertices, indices, run)).Status == Status.Cancelled, "cancelled");
            // The plan stays valid when its device is disposed of.
            device.Dispose();
            device.Dispose();
            plan.Mesh(vertices, indices);
            Check(vertices[0].X == 0 && plan.Draws.Length == 1, "mesh");
        }
        Check(Thrown(() => device.ToString()).Status == Status.Argument, "disposed");
        LiveCloth();
        Pictured();
    }

    static void LiveCloth()
    {
        var plain = "weave = { notation = \"plain\", ends = 6, picks = 6 }\nfinish.settle = false\n"
            + "yarns.a.diameter_mm = 0.2\nwarp = { yarns = [\"a\"], spacing_mm = 0.5 }\n"
            + "weft = { yarns = [\"a\"], spacing_mm = 0.5 }\n";
        using (var device = new Device("cpu"))
        using (var design = Design.Read("plain.toml", Encoding.UTF8.GetBytes(plain)))
        using (var cloth = Cloth.Placed(design))
        using (var check = new Check(cloth))
        using (var live = new Live(cloth, device))
        {
            Check(check.IsClean == (check.ToString() == "clean"), check.ToString());
            Check(check.Json[0] == '{' && check.MeasuresJson[0] == '{', "JSON");
            Check(live.Update(out var anew).Length > 0 && anew, "the first update makes the whole mesh");
            var (vertices, indices) = (new Vertex[live.Vertices], new uint[live.Indices]);
            live.Mesh(vertices, indices);
            var up = live[2, 3];
            live[2, 3] = !up;
            Check(live[2, 3] != up, "lift");
            var changes = live.Update(out anew);
            Check(!anew && changes.Length > 0 && live.Draws.Length > 0, "changes");
            foreach (var change in changes)
            {
                live.Read(
                    change, vertices.AsSpan((int)change.FirstVertex, (int)change.VertexCount),
                    indices.AsSpan((int)change.FirstIndex, (int)change.IndexCount));
            }
            var again = new Vertex[live.Vertices];
            live.Mesh(again, indices);
            var same = MemoryMarshal.AsBytes<Vertex>(again).SequenceEqual(MemoryMarshal.AsBytes<Vertex>(vertices));
            Check(same, "what was read is the mesh");

            // From above the middle of end 3 at pick 4.
            var ray = new Ray { X = 1.25, Y = 1.75, Z = 10, DirectionZ = -1 };
            using (var yarns = cloth.Yarns)
            using (var picker = new Picker(yarns))
            {
                var place = cloth.Place(picker.Pick(ray).Value);
                Check(place == "pick 4 at end 3, a", place);
            }
            using (var yarns = live.Yarns)
            using (var picker = new Picker(yarns))
            {
                var (hit, own) = (picker.Pick(ray).Value, live.Pick(ray).Value);
                Check(hit.Yarn == own.Yarn && hit.Distance == own.Distance && hit.X == 1.25, "hit");
                Check(live.Place(hit) == "end 3 at pick 4, a", live.Place(hit));
                ray.DirectionZ = 1;
                Check(picker.Pick(ray) == null, "nothing is hit");
            }
        }
    }

    static void Pictured()
    {
        using (var yarns = Yarns.Of(new ulong[] { 0, 3 }, new[] { At(0), At(1), At(2) }))
        using (var renderer = new Renderer())
        {
            Check(Thrown(() => renderer.Picture(8, 8)).Status == Status.Argument, "no yarns");
            renderer.Show(yarns);
            var pixels = renderer.Picture(40, 30);
            Check(pixels.Length == 40 * 30 * 4 && pixels[3] == 255, "picture");
            var middle = pixels.AsSpan((15 * 40 + 20) * 4, 4);
            Check(!middle.SequenceEqual(pixels.AsSpan(0, 4)), "the yarn is seen");
        }
    }

    static Point At(float x) => new Point { X = x, HalfWidth = .1f, HalfHeight = .1f };
}
