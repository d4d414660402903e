/* The plug-in from C. */
#include <nrd/plugin.h>
#include <stdio.h>

int main(void)
{
    uint32_t imageNum = 0;
    if (NrdPluginGetImageNum(NRD_PLUGIN_SIGMA_SHADOW, &imageNum) != NRD_PLUGIN_SUCCESS) return 1;
    if (NrdPluginRelease(19) != NRD_PLUGIN_INVALID_ARGUMENT) return 2;
    printf("the plug-in's shadow denoiser takes %u images; %s\n", imageNum, NrdPluginGetLastMessage());
    return 0;
}
