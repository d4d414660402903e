// The interface of nrd/plugin.h for C#: what is said there of threads, errors and fields holds here.
// Structs: new(), then structSize = (uint)Marshal.SizeOf<T>(), then the fields; 0 = default.
using System;
using System.Runtime.InteropServices;

namespace Nrd
{
    public enum NrdPluginResult
    {
        SUCCESS = 0,
        FAILURE = 1,
        INVALID_ARGUMENT = 2,
        UNSUPPORTED = 3
    }

    public enum NrdPluginDenoiser
    {
        REBLUR_DIFFUSE = 0,
        REBLUR_DIFFUSE_OCCLUSION = 1,
        REBLUR_DIFFUSE_SH = 2,
        REBLUR_SPECULAR = 3,
        REBLUR_SPECULAR_OCCLUSION = 4,
        REBLUR_SPECULAR_SH = 5,
        REBLUR_DIFFUSE_SPECULAR = 6,
        REBLUR_DIFFUSE_SPECULAR_OCCLUSION = 7,
        REBLUR_DIFFUSE_SPECULAR_SH = 8,
        REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION = 9,
        RELAX_DIFFUSE = 10,
        RELAX_DIFFUSE_SH = 11,
        RELAX_SPECULAR = 12,
        RELAX_SPECULAR_SH = 13,
        RELAX_DIFFUSE_SPECULAR = 14,
        RELAX_DIFFUSE_SPECULAR_SH = 15,
        SIGMA_SHADOW = 16,
        SIGMA_SHADOW_TRANSLUCENCY = 17,
        REFERENCE = 18
    }

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public delegate IntPtr NrdPluginCommandBufferProvider(IntPtr userArg);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public delegate void NrdPluginMessageCallback(IntPtr userArg, NrdPluginResult result, IntPtr text);

    [StructLayout(LayoutKind.Sequential)]
    public struct NrdPluginDevice
    {
        public uint structSize;
        public uint queueFamilyIndex;
        public IntPtr instance;
        public IntPtr physicalDevice;
        public IntPtr device;
        public IntPtr getInstanceProcAddr;
        public IntPtr getCommandBuffer; // Marshal.GetFunctionPointerForDelegate() of a delegate that is kept alive
        public IntPtr userArg;
        public uint framesInFlight;
        public uint isSynchronization2Enabled;
        public uint isDebugUtilsEnabled;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct NrdPluginImageInfo
    {
        public uint structSize;
        public uint isRequired;
        public uint isOutput;
        public int minFormat; // VkFormat
        public IntPtr name;   // Marshal.PtrToStringAnsi()
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct NrdPluginImage
    {
        public ulong image; // VkImage
        public int format;  // VkFormat
        public uint width;
        public uint height;
        public int layout; // VkImageLayout
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct NrdPluginFrame
    {
        public uint structSize;
        public uint frameIndex;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 16)] public float[] viewToClipMatrix;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 16)] public float[] worldToViewMatrix;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 2)] public float[] cameraJitter;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public float[] motionVectorScale;
        public uint isMotionVectorInWorldSpace;
        public float deltaTime;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public float[] lightDirection;
        [MarshalAs(UnmanagedType.ByValArray, SizeConst = 2)] public uint[] rectSize;
        public float viewZScale;
        public float metersToUnits;
        public float denoisingRange;
        public uint isHistoryReset;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct NrdPluginSettingInfo
    {
        public uint structSize;
        public uint isLowExcluded;
        public IntPtr name; // Marshal.PtrToStringAnsi()
        public double value;
        public double low;
        public double high;
    }

    public static class NrdPlugin
    {
        private const string Library = "nrd_plugin";

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginSetDevice(ref NrdPluginDevice device);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginGetImageNum(uint denoiser, out uint imageNum);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginGetImageInfo(uint denoiser, uint index,
                                                                   ref NrdPluginImageInfo info);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginInitialize(uint denoiser, NrdPluginImage[] images, uint imageNum);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginGetSettingNum(uint denoiser, out uint settingNum);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginGetSettingInfo(uint denoiser, uint index,
                                                                     ref NrdPluginSettingInfo info);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginSetSetting(uint denoiser,
                                                                 [MarshalAs(UnmanagedType.LPStr)] string name,
                                                                 double value);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginSetFrame(ref NrdPluginFrame frame);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern int NrdPluginGetEventId(uint denoiser, uint frameIndex);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginGetEventCallback(out IntPtr callback);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginExecute(int eventId);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginRelease(uint denoiser);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginReleaseAll();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern NrdPluginResult NrdPluginSetMessageCallback(IntPtr callback, IntPtr userArg);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr NrdPluginGetLastMessage(); // Marshal.PtrToStringAnsi()
    }
}
