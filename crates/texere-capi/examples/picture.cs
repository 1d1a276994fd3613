// From a draft to a picture: picture DESIGN DEVICE BITMAP. Yarns come to rest on DEVICE.
using System;
using System.IO;
using Texere;

static class Picture
{
    // Writes a BMP file of 32 bits for each pixel, with rows from the top.
    static void Write(string path, int width, int height, byte[] pixels)
    {
        using (var file = new BinaryWriter(File.Create(path)))
        {
            file.Write(new[] { (byte)'B', (byte)'M' });
            var size = pixels.Length;
            var header = new[] { 54 + size, 0, 54, 40, width, -height, 32 << 16 | 1, 0, size, 0, 0, 0, 0 };
            foreach (var number in header) file.Write(number);
            // A pixel of a BMP file begins with blue.
            for (var at = 0; at < size; at += 4) Array.Reverse(pixels, at, 3);
            file.Write(pixels);
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
            using (var renderer = new Renderer())
            {
                renderer.Show(yarns);
                Write(arguments[2], 640, 480, renderer.Picture(640, 480));
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
