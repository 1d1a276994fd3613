// Pictures of yarns.

using System;

namespace Texere
{
    /// <summary>A device that makes pictures of yarns. One thread at a time may use it.</summary>
    public sealed unsafe class Renderer : Handle
    {
        /// <summary>Opens a device by its name: "auto" for the best one, "wgpu", "wgpu:1" and so on.</summary>
        public Renderer(string name = "auto") : base(Made(name)) { }

        static texere_renderer* Made(string name)
        {
            texere_renderer* made;
            var bytes = Call.Bytes(name);
            fixed (byte* text = bytes)
            {
                Call.Check(Native.texere_renderer_open(text, (UIntPtr)bytes.Length, &made));
            }
            return made;
        }

        texere_renderer* Own => (texere_renderer*)Pointer;

        /// <summary>Shows yarns from now on in place of those before.</summary>
        public void Show(Yarns yarns, Run run = null) =>
            Call.Check(Native.texere_renderer_show(Own, yarns.Own, null, Run.Of(run)), this, yarns, run);

        /// <summary>Makes a picture of the whole cloth from above its face, on light grey ground.</summary>
        /// <param name="width">Pixels across.</param>
        /// <param name="height">Pixels down.</param>
        /// <param name="run">Gets the progress, and can cancel the call.</param>
        /// <returns>Red, green, blue and alpha of each pixel, sRGB, row after row from the top.</returns>
        public byte[] Picture(int width, int height, Run run = null)
        {
            var picture = new texere_picture { struct_size = (uint)sizeof(texere_picture) };
            Call.Check(Native.texere_picture_default(&picture));
            (picture.width, picture.height) = (checked((uint)width), checked((uint)height));
            var pixels = new byte[checked(width * 4 * height)];
            fixed (byte* first = pixels)
            {
                var rows = new texere_view { data = first, size = (ulong)pixels.Length, stride = picture.width * 4ul };
                Call.Check(Native.texere_renderer_picture(Own, &picture, Run.Of(run), &rows), this, run);
            }
            return pixels;
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_renderer_free((texere_renderer*)handle);
            return true;
        }
    }
}
