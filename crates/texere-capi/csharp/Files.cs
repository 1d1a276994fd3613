// Files that the library writes to streams.

using System;
using System.IO;
using System.Runtime.ExceptionServices;

namespace Texere
{
    /// <summary>The forms of a design in a file.</summary>
    public enum DesignFormat : uint
    {
        /// <summary>texere's own design file, .toml.</summary>
        Toml = 0,
        /// <summary>A WIF 1.1 draft, .wif, which has no finish.</summary>
        Wif = 1,
        /// <summary>A program of a knitting machine, knitout, .k.</summary>
        Knitout = 2,
    }

    /// <summary>The forms of a mesh in a file.</summary>
    public enum MeshFormat : uint
    {
        /// <summary>glTF 2.0 in one binary file, .glb.</summary>
        Glb = 0,
        /// <summary>Binary PLY, .ply.</summary>
        Ply = 1,
        /// <summary>Binary STL, .stl: triangles without colours.</summary>
        Stl = 2,
        /// <summary>OBJ, .obj. A stream gets this file alone, which names materials.mtl.</summary>
        Obj = 3,
        /// <summary>glTF 2.0 with vertices of 12 bytes; texere.h says how exact they are.</summary>
        PackedGlb = 4,
        /// <summary>A packed glTF file, compressed to about half of its bytes.</summary>
        CompressedGlb = 5,
        /// <summary>glTF 2.0 that holds each part of a yarn once, however often it recurs.</summary>
        InstancedGlb = 6,
        /// <summary>The text form of Universal Scene Description: a mesh for each yarn.</summary>
        Usda = 7,
        /// <summary>A packed glTF file, compressed further with the later extension KHR_meshopt_compression.</summary>
        KhrCompressedGlb = 8,
    }

    /// <summary>The forms of yarns in a file.</summary>
    public enum YarnsFormat : uint
    {
        /// <summary>texere's own form, .yarns, which keeps every bit.</summary>
        Yarns = 0,
        /// <summary>Binary Curve Collection, .bcc: control points alone.</summary>
        Bcc = 1,
        /// <summary>The text form of Universal Scene Description, .usda: curves with diameters and colours.</summary>
        Usda = 2,
        /// <summary>
        /// The text form of Universal Scene Description, .usda, with straight lines between control
        /// points, for simulators.
        /// </summary>
        LinearUsda = 3,
    }

    /// <summary>A callback of the library that writes the bytes of a file to a stream.</summary>
    internal static unsafe class Files
    {
        internal delegate int Takes(void* user, ulong offset, byte* data, UIntPtr size);

        /// <summary>
        /// Makes a call whose bytes go to a stream, from the stream's position on. An exception of
        /// the stream ends the call and is thrown again here. At the end of a mesh file, earlier
        /// bytes may come again with other values. The stream has to seek then.
        /// </summary>
        internal static void Write(Stream stream, Func<Takes, texere_status> call, params object[] used)
        {
            if (stream == null) throw new ArgumentNullException(nameof(stream));
            ExceptionDispatchInfo thrown = null;
            var start = stream.CanSeek ? stream.Position : 0;
            ulong place = 0, end = 0;
            Takes each = (user, offset, data, size) =>
            {
                try
                {
                    if (offset != place) stream.Position = start + (long)offset;
                    stream.Write(new ReadOnlySpan<byte>(data, checked((int)size)));
                    place = offset + (ulong)size;
                    end = Math.Max(end, place);
                    return 0;
                }
                catch (Exception exception)
                {
                    thrown = ExceptionDispatchInfo.Capture(exception);
                    return 1;
                }
            };
            var status = call(each);
            thrown?.Throw();
            Call.Check(status, used, each);
            if (place != end) stream.Position = start + (long)end;
        }

        /// <summary>Makes a call with a path.</summary>
        internal delegate texere_status Writes(byte* path, UIntPtr length);

        internal static void Write(string path, Writes call, params object[] used)
        {
            var bytes = Call.Bytes(path);
            fixed (byte* text = bytes) Call.Check(call(text, (UIntPtr)bytes.Length), used);
        }
    }
}
