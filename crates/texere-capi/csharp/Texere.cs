// texere for .NET: classes over the library's calls. docs/C.md describes the installation and a first mesh.

using System;
using System.Collections.Generic;
using System.IO;

namespace Texere
{
    /// <summary>Progress and cancellation of calls. Any thread may use them.</summary>
    public sealed unsafe class Run : Handle
    {
        /// <summary>Makes a run, which a program then gives to calls.</summary>
        public Run() : base(Made()) { }

        static texere_run* Made()
        {
            texere_run* made;
            Call.Check(Native.texere_run_new(&made));
            return made;
        }

        texere_run* Own => (texere_run*)Pointer;

        /// <summary>The handle of a run, or null if there is none.</summary>
        internal static texere_run* Of(Run run) => run == null ? null : run.Own;

        /// <summary>
        /// Asks the call that was given this run, and every later one, to end with
        /// <see cref="Status.Cancelled"/>.
        /// </summary>
        public void Cancel() => Call.Check(Native.texere_run_cancel(Own), this);

        /// <summary>The share of the call that is done, from 0 to 1.</summary>
        public double Progress
        {
            get
            {
                double share;
                Call.Check(Native.texere_run_progress(Own, &share), this);
                return share;
            }
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_run_free((texere_run*)handle);
            return true;
        }
    }

    /// <summary>An open device: a GPU, or the CPU.</summary>
    public sealed unsafe class Device : Handle
    {
        /// <summary>Opens a device by its name: "auto" for the best one, "cpu", "opencl:0", "wgpu" and so on.</summary>
        public Device(string name = "auto") : base(Made(name)) { }

        static texere_device* Made(string name)
        {
            texere_device* made;
            var bytes = Call.Bytes(name);
            fixed (byte* text = bytes)
            {
                Call.Check(Native.texere_device_open(text, (UIntPtr)bytes.Length, &made));
            }
            return made;
        }

        internal texere_device* Own => (texere_device*)Pointer;

        texere_device_info Info
        {
            get
            {
                var info = new texere_device_info { struct_size = (uint)sizeof(texere_device_info) };
                Call.Check(Native.texere_device_describe(Own, &info), this);
                return info;
            }
        }

        /// <summary>The name that opens the device, such as "cpu" or "opencl:0".</summary>
        public string Name => Copied(Info.name);
        /// <summary>The maker's name of the device.</summary>
        public override string ToString() => Copied(Info.device);
        /// <summary>The driver of the device, with the version.</summary>
        public string Driver => Copied(Info.driver);
        /// <summary>Whether yarns of all structures can come to rest on the device.</summary>
        public bool Settles => Info.settles != 0;
        /// <summary>How much memory the device has, bytes; 0 if it is not known.</summary>
        public ulong MemoryBytes => Info.memory_bytes;

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_device_free((texere_device*)handle);
            return true;
        }
    }

    /// <summary>
    /// A design that was read: a draft of a weaving program, a design file, or a program of a
    /// knitting machine.
    /// </summary>
    public sealed unsafe class Design : Handle
    {
        Design(texere_design* made) : base(made) { }

        /// <summary>Reads a design from a file: .wif, .dtx, .wpo, .toml or .k.</summary>
        public static Design Read(string path)
        {
            texere_design* made;
            var bytes = Call.Bytes(path);
            fixed (byte* text = bytes)
            {
                Call.Check(Native.texere_design_read(text, (UIntPtr)bytes.Length, &made));
            }
            return new Design(made);
        }

        /// <summary>Reads a design from memory. It may not name other files.</summary>
        /// <param name="name">Stands for the file's name: its ending says what kind of design it is.</param>
        /// <param name="data">The contents of the file.</param>
        public static Design Read(string name, ReadOnlySpan<byte> data)
        {
            texere_design* made;
            var bytes = Call.Bytes(name);
            fixed (byte* text = bytes, first = data)
            {
                Call.Check(Native.texere_design_read_memory(
                    text, (UIntPtr)bytes.Length, first, (UIntPtr)data.Length, null, null, &made));
            }
            return new Design(made);
        }

        internal texere_design* Own => (texere_design*)Pointer;

        /// <summary>Writes the design to a file, .toml, .wif or .k, if that file can hold it.</summary>
        public void Write(string path) =>
            Files.Write(path, (text, length) => Native.texere_design_write(Own, text, length), this);

        /// <summary>Writes the design to a stream, if the format can hold it.</summary>
        public void Write(DesignFormat format, Stream stream) => Files.Write(
            stream,
            each => Native.texere_design_write_to(
                Own, (uint)format, new Native.texere_design_write_to_callback_delegate(each), null),
            this);

        /// <summary>Draws the design on squared paper, from its face or its back, in a .png file.</summary>
        public void Draft(string path, bool back = false) =>
            Files.Write(path, (text, length) => Native.texere_design_draft(Own, back ? 1u : 0, text, length), this);

        /// <summary>Draws the design on squared paper, and writes the bytes of a .png file to a stream.</summary>
        public void Draft(Stream stream, bool back = false) => Files.Write(
            stream,
            each => Native.texere_design_draft_to(
                Own, back ? 1u : 0, new Native.texere_design_draft_to_callback_delegate(each), null),
            this);

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_design_free((texere_design*)handle);
            return true;
        }
    }

    /// <summary>Whether the yarns of a cloth came to rest.</summary>
    public enum Outcome
    {
        /// <summary>They are where the structure places them, as the design or <see cref="Cloth.Placed"/> asks.</summary>
        Placed = 0,
        /// <summary>They came to rest.</summary>
        AtRest = 1,
        /// <summary>They settled without coming to rest.</summary>
        NotAtRest = 2,
        /// <summary>They are where the structure places them: they can't come to rest, and the report says why.</summary>
        Refused = 3,
    }

    /// <summary>The cloth of a design: its yarns, and whether they came to rest.</summary>
    public sealed unsafe class Cloth : Handle
    {
        Cloth(texere_cloth* made) : base(made) { }

        /// <summary>Makes the cloth of a design, with its yarns at rest if the design asks for it.</summary>
        public static Cloth Rest(Design design, Device device, Run run = null)
        {
            texere_cloth* made;
            var status = Native.texere_cloth_rest(design.Own, device.Own, Run.Of(run), &made);
            Call.Check(status, design, device, run);
            return new Cloth(made);
        }

        /// <summary>Makes the cloth of a design with its yarns where the structure places them.</summary>
        public static Cloth Placed(Design design)
        {
            texere_cloth* made;
            Call.Check(Native.texere_cloth_placed(design.Own, &made), design);
            return new Cloth(made);
        }

        internal texere_cloth* Own => (texere_cloth*)Pointer;

        texere_report Told
        {
            get
            {
                var report = new texere_report { struct_size = (uint)sizeof(texere_report) };
                Call.Check(Native.texere_cloth_report(Own, &report), this);
                return report;
            }
        }

        /// <summary>Whether the yarns came to rest.</summary>
        public Outcome Outcome => (Outcome)Told.outcome;

        /// <summary>The outcome in words.</summary>
        public string Report => Copied(Told.words);

        /// <summary>
        /// What a designer should know of the cloth, such as what the design asks for and the cloth
        /// did not reach.
        /// </summary>
        public IReadOnlyList<string> Warnings
        {
            get
            {
                var warnings = new string[Told.warnings];
                for (var number = 0; number < warnings.Length; number++)
                {
                    byte* words;
                    Call.Check(Native.texere_cloth_warning(Own, (ulong)number, &words), this);
                    warnings[number] = Copied(words);
                }
                return warnings;
            }
        }

        /// <summary>The yarns, which stay valid when the cloth is disposed of.</summary>
        public Yarns Yarns
        {
            get
            {
                texere_yarns* made;
                Call.Check(Native.texere_cloth_yarns(Own, &made), this);
                return new Yarns(made);
            }
        }

        /// <summary>What a weaver or a knitter calls the place of a hit, such as "end 3 at pick 4, cotton".</summary>
        public string Place(Hit hit) => Call.Written(
            (words, size, length) =>
            {
                var place = hit;
                return Native.texere_cloth_place(Own, (texere_hit*)&place, words, size, length);
            }, this);

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_cloth_free((texere_cloth*)handle);
            return true;
        }
    }
}
