// What a picture shows, and how.

namespace Texere
{
    /// <summary>A point or a direction, mm.</summary>
    public struct Vector
    {
        /// <summary>Along the weft or the courses.</summary>
        public float X;
        /// <summary>Along the warp or the wales.</summary>
        public float Y;
        /// <summary>Out of the technical face.</summary>
        public float Z;

        /// <summary>A point or a direction.</summary>
        public Vector(float x, float y, float z) => (X, Y, Z) = (x, y, z);

        internal unsafe void CopyTo(float* place)
        {
            place[0] = X;
            place[1] = Y;
            place[2] = Z;
        }
    }

    /// <summary>Where a picture is seen from.</summary>
    public enum View : uint
    {
        /// <summary>The whole cloth from straight above its face.</summary>
        Face = 0,
        /// <summary>The whole cloth from above and aside; <see cref="Picture.Turn"/> turns the eye.</summary>
        Oblique = 1,
        /// <summary>A part of the cloth, <see cref="Picture.WidthMm"/> wide, round a point.</summary>
        CloseUp = 2,
        /// <summary>A cut across the ends, through a point.</summary>
        CutWarp = 3,
        /// <summary>A cut across the picks, through a point.</summary>
        CutWeft = 4,
        /// <summary>What an eye sees from a point.</summary>
        Eye = 5,
        /// <summary>What is seen along a direction, without perspective.</summary>
        Parallel = 6,
    }

    /// <summary>What lies behind the cloth.</summary>
    public enum Background : uint
    {
        /// <summary>Light grey ground, on which the cloth casts its shadow.</summary>
        Ground = 0,
        /// <summary>One colour.</summary>
        Color = 1,
        /// <summary>Nothing: alpha says how much of each pixel shows yarn.</summary>
        Nothing = 2,
    }

    /// <summary>What a picture shows, and how. <see cref="Usual"/> gives one to change.</summary>
    public unsafe struct Picture
    {
        texere_picture native;

        /// <summary>The whole cloth from above its face, on light grey ground.</summary>
        public static Picture Usual(int width, int height)
        {
            var usual = new texere_picture { struct_size = (uint)sizeof(texere_picture) };
            Call.Check(Native.texere_picture_default(&usual));
            var picture = new Picture
            {
                native = usual,
                AtX = usual.at[0],
                AtY = usual.at[1],
                Eye = new Vector(usual.eye[0], usual.eye[1], usual.eye[2]),
                Target = new Vector(usual.target[0], usual.target[1], usual.target[2]),
                Up = new Vector(usual.up[0], usual.up[1], usual.up[2]),
                Red = usual.color[0],
                Green = usual.color[1],
                Blue = usual.color[2],
            };
            (picture.Width, picture.Height) = (width, height);
            return picture;
        }

        /// <summary>Pixels across.</summary>
        public int Width { get => (int)native.width; set => native.width = checked((uint)value); }
        /// <summary>Pixels down.</summary>
        public int Height { get => (int)native.height; set => native.height = checked((uint)value); }
        /// <summary>How many pixels are drawn for each pixel of the picture, in each direction, 1 or more.</summary>
        public uint Supersampling { get => native.supersampling; set => native.supersampling = value; }
        /// <summary>Whether fibres that stand off yarns are drawn.</summary>
        public bool Hairs { get => native.hairs != 0; set => native.hairs = value ? 1u : 0; }
        /// <summary>What lies behind the cloth.</summary>
        public Background Background { get => (Background)native.background; set => native.background = (uint)value; }
        /// <summary>Where the picture is seen from.</summary>
        public View View { get => (View)native.view; set => native.view = (uint)value; }
        /// <summary>Whether the cloth is turned over sideways, so that its back is seen.</summary>
        public bool TurnedOver { get => native.turned_over != 0; set => native.turned_over = value ? 1u : 0; }
        /// <summary>Oblique: how far the eye is turned about the cloth's middle, radians.</summary>
        public float Turn { get => native.turn; set => native.turn = value; }
        /// <summary>Close-up and cuts: how much the picture's width shows, mm.</summary>
        public float WidthMm { get => native.width_mm; set => native.width_mm = value; }
        /// <summary>Parallel: how much the picture's height shows, mm.</summary>
        public float HeightMm { get => native.height_mm; set => native.height_mm = value; }
        /// <summary>Eye: the angle from the picture's lower to its upper edge, radians.</summary>
        public float FieldOfView { get => native.field_of_view; set => native.field_of_view = value; }

        /// <summary>
        /// Close-up and cuts: the point of the cloth round which the close-up lies, or through
        /// which the cut goes, mm, along the weft or the courses.
        /// </summary>
        public float AtX { get; set; }
        /// <summary>Close-up and cuts: the point, mm, along the warp or the wales.</summary>
        public float AtY { get; set; }
        /// <summary>Eye and parallel: the eye.</summary>
        public Vector Eye { get; set; }
        /// <summary>Eye and parallel: the point in the middle of the picture.</summary>
        public Vector Target { get; set; }
        /// <summary>Eye and parallel: the direction that is up in the picture, of any length.</summary>
        public Vector Up { get; set; }
        /// <summary>The red of a background of one colour, sRGB.</summary>
        public byte Red { get; set; }
        /// <summary>The green of a background of one colour, sRGB.</summary>
        public byte Green { get; set; }
        /// <summary>The blue of a background of one colour, sRGB.</summary>
        public byte Blue { get; set; }

        internal texere_picture Own
        {
            get
            {
                var own = native;
                own.at[0] = AtX;
                own.at[1] = AtY;
                Eye.CopyTo(own.eye);
                Target.CopyTo(own.target);
                Up.CopyTo(own.up);
                own.color[0] = Red;
                own.color[1] = Green;
                own.color[2] = Blue;
                return own;
            }
        }
    }

    /// <summary>What a picture shows at a point.</summary>
    public struct Seen
    {
        /// <summary>The yarn, counted from 0.</summary>
        public uint Yarn;
        /// <summary>The place on the yarn's surface, mm, along the weft or the courses.</summary>
        public double X;
        /// <summary>The place along the warp or the wales.</summary>
        public double Y;
        /// <summary>The place out of the technical face.</summary>
        public double Z;
    }
}
