// From a draft to its mesh, and a changed lift: weave DESIGN DEVICE MESH. The file MESH gets the mesh's arrays.
using System;
using System.IO;
using System.Runtime.InteropServices;
using Texere;

static class Weave
{
    static void Write(string path, Plan plan)
    {
        var vertices = new Vertex[plan.Vertices];
        var indices = new uint[plan.Indices];
        plan.Mesh(vertices, indices);
        // Indices count from the base vertex of their draw.
        foreach (var draw in plan.Draws)
        {
            var own = indices.AsSpan((int)draw.FirstIndex, (int)draw.IndexCount);
            for (var number = 0; number < own.Length; number++) own[number] += (uint)draw.BaseVertex;
        }
        using (var file = File.Create(path))
        {
            file.Write(MemoryMarshal.AsBytes<Vertex>(vertices));
            file.Write(MemoryMarshal.AsBytes<uint>(indices));
        }
    }

    static int Main(string[] arguments)
    {
        if (arguments.Length != 3) return 1;
        try
        {
            using (var device = new Device(arguments[1]))
            using (var design = Design.Read(arguments[0]))
            using (var cloth = Cloth.Rest(design, device))
            using (var yarns = cloth.Yarns)
            using (var plan = new Plan(yarns, device))
            using (var live = new Live(cloth, device))
            {
                Write(arguments[2], plan);
                Console.WriteLine($"{cloth.Report}: {plan.Vertices} vertices, {plan.Triangles} triangles");
                live.Update(out _);
                live[2, 3] = !live[2, 3];
                Console.WriteLine($"the lift of end 3 at pick 4 changes {live.Update(out _).Length} stretches");
            }
            return 0;
        }
        catch (TexereException error)
        {
            Console.Error.WriteLine(error.Line == 0 ? error.Message : $"{error.File}:{error.Line}: {error.Message}");
            return (int)error.Status;
        }
    }
}
