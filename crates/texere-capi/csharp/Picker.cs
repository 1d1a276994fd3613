// What a ray hits first of the mesh of yarns.

using System.Runtime.InteropServices;

namespace Texere
{
    /// <summary>A ray: its start, mm, and its direction, of any length but 0.</summary>
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

    /// <summary>The cap of a yarn on which a hit lies, if it lies on one.</summary>
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
        /// <summary>The yarn, counted from 0.</summary>
        public uint Yarn;
        /// <summary>The ring before the triangle that is hit, counted from 0 at the start of the yarn.</summary>
        public uint Ring;
        /// <summary>The corner of the section before the triangle, counted from 0; 0 on a cap.</summary>
        public uint Side;
        /// <summary>The cap that is hit.</summary>
        public Cap Cap;
        /// <summary>The interval of the yarn, from 0: interval n lies between control points n and n + 1.</summary>
        public uint Interval;
        /// <summary>Position along the interval, from 0 to 1.</summary>
        public double T;
        /// <summary>Distance from the start of the ray, in lengths of its direction.</summary>
        public double Distance;
        /// <summary>x of the point that is hit, mm: along the weft or the courses.</summary>
        public double X;
        /// <summary>y of the point, mm: along the warp or the wales.</summary>
        public double Y;
        /// <summary>z of the point, mm: out of the technical face.</summary>
        public double Z;

        internal bool Found => found != 0;
    }

    /// <summary>Says what a ray would hit first of the mesh of yarns. The mesh itself is not made.</summary>
    public sealed unsafe class Picker : Handle
    {
        /// <summary>Makes a picker. Null settings stand for those that suit the yarns.</summary>
        public Picker(Yarns yarns, Settings? settings = null) : base(Made(yarns, settings)) { }

        static texere_picker* Made(Yarns yarns, Settings? settings)
        {
            texere_picker* made;
            var given = settings.GetValueOrDefault().Native;
            var status = Native.texere_picker_new(yarns.Own, settings.HasValue ? &given : null, &made);
            Call.Check(status, yarns);
            return made;
        }

        /// <summary>What a ray hits first, from either side, or null if it hits nothing.</summary>
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
