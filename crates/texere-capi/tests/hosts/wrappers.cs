// What the classes for C# promise beyond the calls: exceptions, disposal, structs that lie as the library's do.
using System;
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
            // The plan keeps its device.
            device.Dispose();
            device.Dispose();
            plan.Mesh(vertices, indices);
            Check(vertices[0].X == 0 && plan.Draws.Length == 1, "mesh");
        }
        Check(Thrown(() => device.ToString()).Status == Status.Argument, "disposed");
    }

    static Point At(float x) => new Point { X = x, HalfWidth = .1f, HalfHeight = .1f };
}
