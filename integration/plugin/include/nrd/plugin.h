/* The denoisers for engines that call plug-ins by events: a C interface, C99 and C++17.
 *
 * Main thread, once: NrdPluginSetDevice(), then NrdPluginInitialize() for each denoiser with the engine's images.
 * Main thread, per frame: NrdPluginSetFrame(), which keeps the frame in slot `frameIndex & 3` of a ring; then queue
 * events with NrdPluginGetEventId(denoiser, frameIndex) for the render thread.
 * Render thread: the callback of NrdPluginGetEventCallback() asks the engine for its current command buffer and records
 * the denoiser into it. It may lag the main thread by three frames. What an event uses is fixed when its frame is set:
 * a denoiser initialised later is not there yet, one released or initialised anew still has the images it had.
 *
 * Threads: every function from any thread, except that NrdPluginReleaseAll() must be the only one that runs.
 * Errors: no exception leaves, nothing asserts. A refused call changes nothing, records nothing, and has one sentence
 * for NrdPluginGetLastMessage() of its thread and for the callback of NrdPluginSetMessageCallback().
 * Structs: zero them, set structSize, fill in. A field that is 0 has the default that is said beside it. */
#ifndef NRD_PLUGIN_H
#define NRD_PLUGIN_H
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#if defined(_WIN32) && defined(NRD_PLUGIN_BUILDING)
#define NRD_PLUGIN_API __declspec(dllexport)
#elif defined(_WIN32)
#define NRD_PLUGIN_API __declspec(dllimport)
#else
#define NRD_PLUGIN_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C"
{
#endif

    typedef enum NrdPluginResult
    {
        NRD_PLUGIN_SUCCESS = 0,
        NRD_PLUGIN_FAILURE = 1, /* memory, or an error of the device underneath */
        NRD_PLUGIN_INVALID_ARGUMENT = 2,
        NRD_PLUGIN_UNSUPPORTED = 3 /* by this build or this device */
    } NrdPluginResult;

    /* Order is part of the interface; it only grows. */
    typedef enum NrdPluginDenoiser
    {
        NRD_PLUGIN_REBLUR_DIFFUSE = 0,
        NRD_PLUGIN_REBLUR_DIFFUSE_OCCLUSION = 1,
        NRD_PLUGIN_REBLUR_DIFFUSE_SH = 2,
        NRD_PLUGIN_REBLUR_SPECULAR = 3,
        NRD_PLUGIN_REBLUR_SPECULAR_OCCLUSION = 4,
        NRD_PLUGIN_REBLUR_SPECULAR_SH = 5,
        NRD_PLUGIN_REBLUR_DIFFUSE_SPECULAR = 6,
        NRD_PLUGIN_REBLUR_DIFFUSE_SPECULAR_OCCLUSION = 7,
        NRD_PLUGIN_REBLUR_DIFFUSE_SPECULAR_SH = 8,
        NRD_PLUGIN_REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION = 9,
        NRD_PLUGIN_RELAX_DIFFUSE = 10,
        NRD_PLUGIN_RELAX_DIFFUSE_SH = 11,
        NRD_PLUGIN_RELAX_SPECULAR = 12,
        NRD_PLUGIN_RELAX_SPECULAR_SH = 13,
        NRD_PLUGIN_RELAX_DIFFUSE_SPECULAR = 14,
        NRD_PLUGIN_RELAX_DIFFUSE_SPECULAR_SH = 15,
        NRD_PLUGIN_SIGMA_SHADOW = 16,
        NRD_PLUGIN_SIGMA_SHADOW_TRANSLUCENCY = 17,
        NRD_PLUGIN_REFERENCE = 18
    } NrdPluginDenoiser;

    /* The command buffer the engine records now: in the recording state, outside a render pass, of the device's queue
     * family. Called on the render thread within the event; null refuses the event. */
    typedef VkCommandBuffer (*NrdPluginCommandBufferProvider)(void* userArg);
    typedef void (*NrdPluginEventCallback)(int eventId);
    typedef void (*NrdPluginMessageCallback)(void* userArg, NrdPluginResult result, const char* text);

    /* Native objects of the engine: borrowed until NrdPluginReleaseAll(). Vulkan 1.1, the device created with the
     * features shaderStorageImageWriteWithoutFormat and shaderStorageImageExtendedFormats. */
    typedef struct NrdPluginDevice
    {
        uint32_t structSize;       /* sizeof(NrdPluginDevice) */
        uint32_t queueFamilyIndex; /* must have compute */
        VkInstance instance;
        VkPhysicalDevice physicalDevice;
        VkDevice device;
        PFN_vkGetInstanceProcAddr getInstanceProcAddr;
        NrdPluginCommandBufferProvider getCommandBuffer;
        void* userArg;           /* of getCommandBuffer */
        uint32_t framesInFlight; /* that the GPU may still work on when the next one begins; [1; 16], 0 = 3 */
        uint32_t isSynchronization2Enabled; /* the feature, through Vulkan 1.3 or VK_KHR_synchronization2 */
        uint32_t isDebugUtilsEnabled;       /* VK_EXT_debug_utils on the instance */
        uint32_t reserved;                  /* 0 */
    } NrdPluginDevice;

    /* One entry of the array that NrdPluginInitialize() takes. */
    typedef struct NrdPluginImageInfo
    {
        uint32_t structSize; /* sizeof(NrdPluginImageInfo) */
        uint32_t isRequired; /* 0: the entry may be a zeroed NrdPluginImage */
        uint32_t isOutput;   /* 1: needs VK_IMAGE_USAGE_STORAGE_BIT; all need VK_IMAGE_USAGE_SAMPLED_BIT */
        VkFormat minFormat;  /* the least that keeps what the image carries */
        const char* name;    /* "IN_VIEWZ"; lives as long as the library */
    } NrdPluginImageInfo;

    /* 2D, one layer, one mip, owned by the device's queue family or shared with it. The format of IN_NORMAL_ROUGHNESS
     * says how normals are encoded. */
    typedef struct NrdPluginImage
    {
        VkImage image;
        VkFormat format;
        uint32_t width;       /* pixels */
        uint32_t height;      /* pixels */
        VkImageLayout layout; /* that every event finds the image in and leaves it in, visible to all commands */
    } NrdPluginImage;

    /* Matrices are column-major, for column vectors, without jitter; clip space is Y up with depth in [0; 1], reversed
     * and infinite depth allowed. Last frame's are remembered; a denoiser that was not executed in the frame
     * `frameIndex - 1` begins anew. */
    typedef struct NrdPluginFrame
    {
        uint32_t structSize;        /* sizeof(NrdPluginFrame) */
        uint32_t frameIndex;        /* + 1 per frame */
        float viewToClipMatrix[16]; /* perspective or orthographic */
        float worldToViewMatrix[16];
        float cameraJitter[2];      /* [-0.5; 0.5] pixels, sample position = pixel centre + jitter */
        float motionVectorScale[3]; /* mv = IN_MV * scale, previous - current; all 0 = (1, 1, 0) on the screen */
        uint32_t isMotionVectorInWorldSpace; /* scene motion only, camera excluded; all scales 0 = static scene */
        float deltaTime;                     /* >= 0 seconds, 0 = measured inside */
        float lightDirection[3];             /* SIGMA: world space, from the surface to the light; all 0 = unknown */
        uint32_t rectSize[2];    /* active part of the images in pixels, from their origin; 0 = all of them */
        float viewZScale;        /* viewZ = abs(IN_VIEWZ * viewZScale); 0 = 1 */
        float metersToUnits;     /* world units per metre; 0 = 1 */
        float denoisingRange;    /* world units, beyond it nothing is written; 0 = 500000 */
        uint32_t isHistoryReset; /* 1: begin anew, as after a camera cut */
    } NrdPluginFrame;

    /* One number of a denoiser's settings, which nrd/settings.h documents. */
    typedef struct NrdPluginSettingInfo
    {
        uint32_t structSize;    /* sizeof(NrdPluginSettingInfo) */
        uint32_t isLowExcluded; /* 1: (low; high], 0: [low; high] */
        const char* name;       /* "antilagSettings.resetAmount", "lightPosition[0]"; lives as long as the library */
        double value;           /* that frames have which are set from now on; flags 0 or 1, modes their number */
        double low;             /* both 0: a flag, a mode, or a number without bounds */
        double high;            /* may be infinite */
    } NrdPluginSettingInfo;

    /* Once before all else, and again after NrdPluginReleaseAll(). */
    NRD_PLUGIN_API NrdPluginResult NrdPluginSetDevice(const NrdPluginDevice* device);

    /* The array of images that NrdPluginInitialize() takes: its length, and the meaning of each entry. No device
     * needed. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginGetImageNum(uint32_t denoiser, uint32_t* imageNum);
    NRD_PLUGIN_API NrdPluginResult NrdPluginGetImageInfo(uint32_t denoiser, uint32_t index, NrdPluginImageInfo* info);

    /* Creates textures and pipelines, which takes its time; for frames that are set from now on. A denoiser that is
     * there already gets other images, and its history goes on in them. Where their size is another, the first event
     * with them makes textures of that size and takes the history along; refused with NRD_PLUGIN_FAILURE where there is
     * no memory for them, and tried again by the next. Only with another encoding of normals does it begin anew. The
     * images before must live until the GPU is done with the frames that were set so far. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginInitialize(uint32_t denoiser, const NrdPluginImage* images,
                                                       uint32_t imageNum);

    /* The settings of a denoiser that it does not share with all: their number, and each of them. No device needed. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginGetSettingNum(uint32_t denoiser, uint32_t* settingNum);
    NRD_PLUGIN_API NrdPluginResult NrdPluginGetSettingInfo(uint32_t denoiser, uint32_t index,
                                                           NrdPluginSettingInfo* info);

    /* For frames that are set from now on, initialised or not, until NrdPluginReleaseAll(). Refused where the settings
     * as a whole would not be valid, so the order may matter. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginSetSetting(uint32_t denoiser, const char* name, double value);

    /* Not before the render thread is done with the frame `frameIndex - 4`, whose slot it takes. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginSetFrame(const NrdPluginFrame* frame);

    /* Bits 0-7 the denoiser, bits 8-9 the slot of the ring, the others 0; -1, which is refused, for no denoiser's
     * index. */
    NRD_PLUGIN_API int NrdPluginGetEventId(uint32_t denoiser, uint32_t frameIndex);

    /* For the render thread: the callback is NrdPluginExecute() without its result. Each denoiser once per frame; the
     * GPU must have finished the frame `framesInFlight` frames ago. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginGetEventCallback(NrdPluginEventCallback* callback);
    NRD_PLUGIN_API NrdPluginResult NrdPluginExecute(int eventId);

    /* For frames that are set from now on. Never waits: what the GPU may still use goes some frames later, so the
     * images must live until the GPU is done with the frames that were set so far. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginRelease(uint32_t denoiser);

    /* Everything at once, the device too. The GPU must be done, and no other call may run. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginReleaseAll(void);

    /* Null for none. Called on the thread that made the refused call, within it. */
    NRD_PLUGIN_API NrdPluginResult NrdPluginSetMessageCallback(NrdPluginMessageCallback callback, void* userArg);

    /* The sentence of this thread's last refusal; empty if there was none. Valid until the thread's next refusal. */
    NRD_PLUGIN_API const char* NrdPluginGetLastMessage(void);

#ifdef __cplusplus
}
#endif
#endif
