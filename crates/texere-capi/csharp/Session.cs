// A mesh that stays on its device, for programs that draw with OpenCL or Vulkan.

using System;
using System.Runtime.InteropServices;

namespace Texere
{
    /// <summary>The interface whose objects a session lends.</summary>
    public enum NativeKind : uint
    {
        /// <summary>Buffers are cl_mem.</summary>
        OpenCl = 1,
        /// <summary>Buffers are VkBuffer.</summary>
        Vulkan = 2,
    }

    /// <summary>The objects of OpenCL or Vulkan that a session works with. They are valid until it is disposed of.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct NativeObjects
    {
        internal uint size;
        /// <summary>The interface.</summary>
        public NativeKind Kind;
        /// <summary>The VkInstance; 0 with OpenCL.</summary>
        public ulong Instance;
        /// <summary>The VkPhysicalDevice; 0 with OpenCL.</summary>
        public ulong PhysicalDevice;
        /// <summary>The VkDevice or cl_context.</summary>
        public ulong Device;
        /// <summary>The VkQueue or cl_command_queue that chunks are made on.</summary>
        public ulong Queue;
        /// <summary>The family of the VkQueue; 0 with OpenCL.</summary>
        public uint QueueFamily;
        readonly uint reserved;
    }

    /// <summary>A part of a buffer on a device.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct DeviceBuffer
    {
        /// <summary>The cl_mem or VkBuffer; 0 if there are no values.</summary>
        public ulong Buffer;
        /// <summary>Where in the buffer the values begin, bytes.</summary>
        public ulong Offset;
        /// <summary>The size of all values, bytes.</summary>
        public ulong Size;
    }

    /// <summary>The mesh of a chunk on its device. texere.h says what a program has to wait for before it reads.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct DeviceMesh
    {
        internal uint size;
        /// <summary>The interface.</summary>
        public NativeKind Kind;
        /// <summary>The vertices, six floats each.</summary>
        public DeviceBuffer Vertices;
        /// <summary>The indices, four bytes each. They count from the chunk's first vertex.</summary>
        public DeviceBuffer Indices;
        /// <summary>With OpenCL the cl_event of the last command that writes the buffers; 0 with Vulkan.</summary>
        public ulong Ready;
    }

    /// <summary>
    /// A session, which makes the mesh of a plan on the plan's device, chunk by chunk, and leaves
    /// the chunks there. One thread at a time may use a session.
    /// </summary>
    public sealed unsafe class Session : Handle
    {
        /// <summary>
        /// Sends the yarns of a plan to the plan's device. It has to be a device that lends its
        /// buffers: one of opencl, or of wgpu with Vulkan.
        /// </summary>
        public Session(Plan plan, Run run = null) : base(Made(plan, run)) { }

        static texere_session* Made(Plan plan, Run run)
        {
            texere_session* made;
            Call.Check(Native.texere_session_new(plan.Own, Run.Of(run), &made), plan, run);
            return made;
        }

        texere_session* Own => (texere_session*)Pointer;

        /// <summary>The objects that the session works with.</summary>
        public NativeObjects Objects
        {
            get
            {
                var found = new NativeObjects { size = (uint)sizeof(texere_native) };
                Call.Check(Native.texere_session_native(Own, (texere_native*)&found), this);
                return found;
            }
        }

        /// <summary>Makes a chunk on the device, and lends its buffers until two other chunks have been made.</summary>
        /// <param name="chunk">The chunk, from 0 to below <see cref="Plan.Chunks"/>.</param>
        public DeviceMesh Mesh(ulong chunk)
        {
            var mesh = new DeviceMesh { size = (uint)sizeof(texere_device_mesh) };
            Call.Check(Native.texere_session_mesh(Own, chunk, (texere_device_mesh*)&mesh), this);
            return mesh;
        }

        /// <summary>Waits until the device has done all that was asked of it.</summary>
        public void Wait() => Call.Check(Native.texere_session_wait(Own), this);

        /// <summary>
        /// Reads a chunk that <see cref="Mesh"/> has made. The spans have to be as long as the
        /// chunk's numbers of vertices and indices.
        /// </summary>
        public void Read(ulong chunk, Span<Vertex> vertices, Span<uint> indices)
        {
            fixed (Vertex* firstVertex = vertices)
            fixed (uint* firstIndex = indices)
            {
                var status = Native.texere_session_read(
                    Own, chunk, (texere_vertex*)firstVertex, (ulong)vertices.Length, firstIndex,
                    (ulong)indices.Length);
                Call.Check(status, this);
            }
        }

        /// <inheritdoc/>
        protected override bool ReleaseHandle()
        {
            Native.texere_session_free((texere_session*)handle);
            return true;
        }
    }
}
