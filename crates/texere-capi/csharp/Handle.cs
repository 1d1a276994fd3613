// What all classes of Texere stand on: owned handles, exceptions, texts.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Texere
{
    /// <summary>Why a call failed.</summary>
    public enum Status
    {
        /// <summary>A wrong size, something that was disposed of, or a value out of its range.</summary>
        Argument = 1,
        /// <summary>The design can't be read, or its cloth can't be made.</summary>
        Design = 2,
        /// <summary>There is no such device, or it failed.</summary>
        Device = 3,
        /// <summary>Memory did not suffice, on the host or on the device.</summary>
        Memory = 4,
        /// <summary>A file can't be read or written.</summary>
        IO = 5,
        /// <summary>The call ended early since <see cref="Run.Cancel"/> was called.</summary>
        Cancelled = 6,
        /// <summary>The library was built without what the call needs, or the device can't do it.</summary>
        Unsupported = 7,
        /// <summary>A fault of the library. It was caught, and the library can still be used.</summary>
        Panic = 8,
    }

    /// <summary>A call of the library that failed. Its message has all causes.</summary>
    public sealed class TexereException : Exception
    {
        /// <summary>Why it failed.</summary>
        public Status Status { get; }
        /// <summary>The design's file that is at fault; null where the error has no place.</summary>
        public string File { get; }
        /// <summary>The line, from 1; 0 where it is not known.</summary>
        public ulong Line { get; }
        /// <summary>The column, in letters from 1; 0 where it is not known.</summary>
        public ulong Column { get; }

        internal TexereException(Status status, string message, string file, ulong line, ulong column)
            : base(message)
        {
            (Status, File, Line, Column) = (status, file, line, column);
        }
    }

    /// <summary>Something that the library made. Disposing of it frees it; what was made from it stays valid.</summary>
    public abstract unsafe class Handle : SafeHandle
    {
        static Handle()
        {
            if (Native.texere_abi() != Native.TEXERE_ABI)
            {
                throw new DllNotFoundException(
                    $"libtexere_c has binary interface {Native.texere_abi()}, and Texere needs {Native.TEXERE_ABI}");
            }
        }

        internal Handle(void* made) : base(IntPtr.Zero, true) => SetHandle((IntPtr)made);

        /// <summary>Whether there is nothing to free.</summary>
        public sealed override bool IsInvalid => handle == IntPtr.Zero;

        /// <summary>The handle for a call; one that was disposed of is null, which the library refuses.</summary>
        internal void* Pointer => IsClosed ? null : (void*)handle;

        /// <summary>A copy of a text that the library lends as long as this handle lives.</summary>
        internal string Copied(byte* lent)
        {
            var copied = Call.Text(lent);
            GC.KeepAlive(this);
            return copied;
        }
    }

    internal static unsafe class Call
    {
        /// <summary>
        /// Throws what went wrong in a call. <paramref name="used"/> is what the call used: it lives until here,
        /// so that no finalizer frees it while the call runs.
        /// </summary>
        internal static void Check(texere_status status, params object[] used)
        {
            GC.KeepAlive(used);
            if (status == texere_status.TEXERE_OK) return;
            var message = Text(Native.texere_error_message());
            texere_place place;
            Native.texere_error_place(&place);
            throw new TexereException((Status)status, message, Text(place.file), place.line, place.column);
        }

        /// <summary>A text of the library's; null where it is.</summary>
        internal static string Text(byte* text) => Marshal.PtrToStringUTF8((IntPtr)text);

        /// <summary>Writes a text to memory of <paramref name="size"/> bytes, and says how long it is.</summary>
        internal delegate texere_status Writes(byte* words, UIntPtr size, UIntPtr* length);

        /// <summary>The text that a call writes where there is room for it.</summary>
        internal static string Written(Writes call, Handle used)
        {
            UIntPtr length;
            Check(call(null, UIntPtr.Zero, &length), used);
            var words = new byte[(int)length + 1];
            fixed (byte* first = words)
            {
                Check(call(first, (UIntPtr)words.Length, &length), used);
            }
            return Encoding.UTF8.GetString(words, 0, (int)length);
        }

        /// <summary>A text for the library.</summary>
        internal static byte[] Bytes(string text) =>
            Encoding.UTF8.GetBytes(text ?? throw new ArgumentNullException(nameof(text)));
    }
}
