// What all classes of Texere use: owned handles, exceptions, texts.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Texere
{
    /// <summary>Why a call failed.</summary>
    public enum Status
    {
        /// <summary>A value out of its range, a wrong size, or an object that was disposed of or is in use.</summary>
        Argument = 1,
        /// <summary>A file holds no design or no yarns, or the cloth of a design can't be made.</summary>
        Design = 2,
        /// <summary>There is no such device, or it failed.</summary>
        Device = 3,
        /// <summary>Memory did not suffice, on the host or on the device.</summary>
        Memory = 4,
        /// <summary>A file can't be read or written.</summary>
        IO = 5,
        /// <summary>The call ended early, because <see cref="Run.Cancel"/> was called.</summary>
        Cancelled = 6,
        /// <summary>
        /// The library was built without what the call needs, or the device or the file format does
        /// not support it.
        /// </summary>
        Unsupported = 7,
        /// <summary>The library itself is at fault. The fault was caught, and the library can still be used.</summary>
        Panic = 8,
    }

    /// <summary>A call of the library failed. The message has all causes.</summary>
    public sealed class TexereException : Exception
    {
        /// <summary>Why the call failed.</summary>
        public Status Status { get; }
        /// <summary>The design's file that is at fault; null if the error has no place.</summary>
        public string File { get; }
        /// <summary>The line, counted from 1; 0 if it is not known.</summary>
        public ulong Line { get; }
        /// <summary>The column, in letters counted from 1; 0 if it is not known.</summary>
        public ulong Column { get; }

        internal TexereException(Status status, string message, string file, ulong line, ulong column)
            : base(message)
        {
            (Status, File, Line, Column) = (status, file, line, column);
        }
    }

    /// <summary>An object of the library. Dispose frees it; objects that were made from it stay valid.</summary>
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

        /// <summary>The handle for a call. It is null after Dispose, and the library refuses null.</summary>
        internal void* Pointer => IsClosed ? null : (void*)handle;

        /// <summary>A copy of a text that the library lends until this handle is freed.</summary>
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
        /// Throws an exception if a call failed. <paramref name="used"/> are the objects that the call used. They
        /// are kept alive until here, so that no finalizer frees them while the call runs.
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

        /// <summary>A copy of a text of the library's, or null for a null pointer.</summary>
        internal static string Text(byte* text) => Marshal.PtrToStringUTF8((IntPtr)text);

        /// <summary>A call that writes a text to memory of <paramref name="size"/> bytes, and its length.</summary>
        internal delegate texere_status Writes(byte* words, UIntPtr size, UIntPtr* length);

        /// <summary>The text of a call, which is made twice: for the length, and for the text.</summary>
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

        /// <summary>A text as UTF-8, for the library.</summary>
        internal static byte[] Bytes(string text) =>
            Encoding.UTF8.GetBytes(text ?? throw new ArgumentNullException(nameof(text)));
    }
}
