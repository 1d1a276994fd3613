// A draft to a mesh: weave DESIGN DEVICE MESH. The arrays go to the file MESH as they lie in memory.
using System;
using System.IO;
using System.Runtime.InteropServices;
using Texere;

static class Weave
{
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
            using (var file = File.Create(arguments[2]))
            {
                var vertices = new Vertex[plan.Vertices];
                var indices = new uint[plan.Indices];
                plan.Mesh(vertices, indices);
                Console.WriteLine($"{cloth.Report}: {plan.Vertices} vertices, {plan.Triangles} triangles");
                // Indices count from the first vertex of their draw.
                foreach (var draw in plan.Draws)
                {
                    var own = indices.AsSpan((int)draw.FirstIndex, (int)draw.IndexCount);
                    for (var number = 0; number < own.Length; number++) own[number] += (uint)draw.BaseVertex;
                }
                file.Write(MemoryMarshal.AsBytes<Vertex>(vertices));
                file.Write(MemoryMarshal.AsBytes<uint>(indices));
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
