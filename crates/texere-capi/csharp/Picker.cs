// What a ray hits first of yarns.

using System.Runtime.InteropServices;

namespace Texere
{
    /// <summary>A ray: where it starts, mm, and a direction of any length but 0.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Ray
    {
        /// <summary>The start along the weft or the courses.</summary>
        public double X;
        /// <summary>The start along the warp or the wales.</summary>
        public double Y;
        /// <summary>The start out of the technical face.</summary>
        public double Z;
        /// <summary>The direction along x.</summary>
        public double DirectionX;
        /// <summary>The direction along y.</summary>
        public double DirectionY;
        /// <summary>The direction along z.</summary>
        public double DirectionZ;
    }

    /// <summary>Where on a yarn's surface a hit is.</summary>
    public enum Cap : uint
    {
        /// <summary>On no cap: the hit is on the side of the yarn.</summary>
        None = 0,
        /// <summary>On the cap that closes the start of the yarn.</summary>
        Start = 1,
        /// <summary>On the cap that closes the end of the yarn.</summary>
        Finish = 2,
    }

    /// <summary>What a ray hits first.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Hit
    {
        readonly uint found;
        /// <summary>The yarn, from 0.</summary>
        public uint Yarn;
        /// <summary>The ring before the triangle, from the start of the yarn.</summary>
        public uint Ring;
        /// <summary>The corner of the section before the triangle, from 0; 0 on a cap.</summary>
        public uint Side;
        /// <summary>The cap that is hit.</summary>
        public Cap Cap;
        /// <summary>The control interval of the yarn, from 0: that between this control point and the next.</summary>
        public uint Interval;
        /// <summary>How far along the interval, from 0 to 1.</summary>
        public double T;
        /// <summary>Distance from the start of the ray, in lengths of its direction.</summary>
        public double Distance;
        /// <summary>The point that is hit, mm, along the weft or the courses.</summary>
        public double X;
        /// <summary>The point along the warp or the wales.</summary>
        public double Y;
        /// <summary>The point out of the technical face.</summary>
        public double Z;

        internal bool Found => found != 0;
    }

    /// <summary>Says what a ray hits first of the mesh of yarns, without the mesh.</summary>
    public sealed unsafe class Picker : Handle
    {
        /// <summary>Makes a picker, with the settings that suit the yarns unless others are given.</summary>
        public Picker(Yarns yarns, Settings? settings = null) : base(Made(yarns, settings)) { }

        static texere_picker* Made(Yarns yarns, Settings? settings)
        {
            texere_picker* made;
            var given = settings.GetValueOrDefault().Native;
            var status = Native.texere_picker_new(yarns.Own, settings.HasValue ? &given : null, &made);
            Call.Check(status, yarns);
            return made;
        }

        /// <summary>What a ray hits first, from either side; null where it hits nothing.</summary>
        public Hit? Pick(Ray ray)
        {
            Hit hit;
            var status = Native.texere_picker_pick((texere_picker*)Pointer, (texere_ray*)&ray, (texere_hit*)&hit);
            Call.Check(status, this);
            return hit.Found ? hit : default(Hit?);
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_picker_free((texere_picker*)handle);
            return true;
        }
    }
}
