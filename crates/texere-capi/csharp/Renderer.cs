// Pictures of yarns.

using System;
using System.IO;

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

        /// <summary>
        /// Shows yarns from now on in place of the yarns before. Null settings stand for settings
        /// that suit a picture.
        /// </summary>
        public void Show(Yarns yarns, Settings? settings = null, Run run = null)
        {
            var given = settings.GetValueOrDefault().Native;
            var status = Native.texere_renderer_show(
                Own, yarns.Own, settings.HasValue ? &given : null, Run.Of(run));
            Call.Check(status, this, yarns, run);
        }

        /// <summary>The corners of the box round the yarns that the renderer shows.</summary>
        public (Vector Low, Vector High) Extent
        {
            get
            {
                texere_extent extent;
                Call.Check(Native.texere_renderer_extent(Own, &extent), this);
                return (
                    new Vector(extent.low[0], extent.low[1], extent.low[2]),
                    new Vector(extent.high[0], extent.high[1], extent.high[2]));
            }
        }

        /// <summary>Makes a picture of the whole cloth from above its face, on light grey ground.</summary>
        /// <param name="width">Pixels across.</param>
        /// <param name="height">Pixels down.</param>
        /// <param name="run">Gets the progress, and can cancel the call.</param>
        /// <returns>Red, green, blue and alpha of each pixel, sRGB, row after row from the top.</returns>
        public byte[] Picture(int width, int height, Run run = null)
        {
            var pixels = new byte[checked(width * 4 * height)];
            Picture(Texere.Picture.Usual(width, height), pixels, run);
            return pixels;
        }

        /// <summary>Makes a picture in memory of the caller's.</summary>
        /// <param name="picture">What it shows.</param>
        /// <param name="pixels">Gets red, green, blue and alpha of each pixel, sRGB, row after row from the top.</param>
        /// <param name="run">Gets the progress, and can cancel the call.</param>
        public void Picture(in Picture picture, Span<byte> pixels, Run run = null)
        {
            var own = picture.Own;
            fixed (byte* first = pixels)
            {
                var rows = new texere_view { data = first, size = (ulong)pixels.Length, stride = own.width * 4ul };
                Call.Check(Native.texere_renderer_picture(Own, &own, Run.Of(run), &rows), this, run);
            }
        }

        /// <summary>Makes a picture in a .png file.</summary>
        public void Write(Picture picture, string path, Run run = null)
        {
            var own = picture.Own;
            Files.Write(path, (text, length) =>
            {
                var given = own;
                return Native.texere_renderer_write(Own, &given, Run.Of(run), text, length);
            }, this, run);
        }

        /// <summary>Makes a picture and writes the bytes of a .png file to a stream.</summary>
        public void Write(Picture picture, Stream stream, Run run = null)
        {
            var own = picture.Own;
            Files.Write(stream, each =>
            {
                var given = own;
                return Native.texere_renderer_write_to(
                    Own, &given, Run.Of(run), new Native.texere_renderer_write_to_callback_delegate(each), null);
            }, this, run);
        }

        /// <summary>What the last picture shows at a point, in pixels from its left and upper edges; null for no yarn.</summary>
        public Seen? Seen(float x, float y)
        {
            texere_seen seen;
            Call.Check(Native.texere_renderer_seen(Own, x, y, &seen), this);
            if (seen.is_yarn == 0) return null;
            return new Seen { Yarn = seen.yarn, X = seen.position[0], Y = seen.position[1], Z = seen.position[2] };
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_renderer_free((texere_renderer*)handle);
            return true;
        }
    }
}
