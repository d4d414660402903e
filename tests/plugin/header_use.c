/* Compiled as C99 and as C++17: every declaration of the header is used. */
#include <nrd/plugin.h>

static VkCommandBuffer currentCommandBuffer(void* userArg) { return *(VkCommandBuffer*)userArg; }

static void onMessage(void* userArg, NrdPluginResult result, const char* text)
{
    const char** last = (const char**)userArg;
    if (result != NRD_PLUGIN_SUCCESS) *last = text;
}

int denoise(VkCommandBuffer* commandBuffer, const NrdPluginImage* images, uint32_t imageNum, const char** message);
int denoise(VkCommandBuffer* commandBuffer, const NrdPluginImage* images, uint32_t imageNum, const char** message)
{
    NrdPluginDevice device = {sizeof(NrdPluginDevice), 0, 0, 0, 0, 0, currentCommandBuffer, 0, 0, 0, 0, 0};
    NrdPluginImageInfo info = {sizeof(NrdPluginImageInfo), 0, 0, VK_FORMAT_UNDEFINED, 0};
    NrdPluginFrame frame = {sizeof(NrdPluginFrame), 1,   {0},  {0},  {0},  {0}, 0, 0.016f,
                            {0.0f, 1.0f, 0.0f},     {0}, 1.0f, 1.0f, 0.0f, 0};
    NrdPluginEventCallback callback = 0;
    uint32_t expectedNum = 0;
    device.userArg = commandBuffer;
    (void)NrdPluginSetMessageCallback(onMessage, (void*)message);
    if (NrdPluginSetDevice(&device) != NRD_PLUGIN_SUCCESS) return 1;
    if (NrdPluginGetImageNum(NRD_PLUGIN_SIGMA_SHADOW, &expectedNum) != NRD_PLUGIN_SUCCESS) return 2;
    if (NrdPluginGetImageInfo(NRD_PLUGIN_SIGMA_SHADOW, 0, &info) != NRD_PLUGIN_SUCCESS) return 3;
    if (NrdPluginInitialize(NRD_PLUGIN_SIGMA_SHADOW, images, imageNum) != NRD_PLUGIN_SUCCESS) return 4;
    if (NrdPluginSetFrame(&frame) != NRD_PLUGIN_SUCCESS) return 5;
    if (NrdPluginGetEventCallback(&callback) != NRD_PLUGIN_SUCCESS) return 6;
    callback(NrdPluginGetEventId(NRD_PLUGIN_SIGMA_SHADOW, frame.frameIndex));
    if (NrdPluginExecute(NrdPluginGetEventId(NRD_PLUGIN_SIGMA_SHADOW, 2)) != NRD_PLUGIN_SUCCESS) return 7;
    if (NrdPluginRelease(NRD_PLUGIN_SIGMA_SHADOW) != NRD_PLUGIN_SUCCESS) return 8;
    if (NrdPluginReleaseAll() != NRD_PLUGIN_SUCCESS) return 9;
    return NrdPluginGetLastMessage()[0] == 0 && expectedNum == imageNum && info.name ? 0 : 10;
}
