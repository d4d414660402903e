#include "window/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

namespace window
{
namespace
{
using engine::check;
using engine::describe;

engine::UniqueDescriptorPool createPool(const engine::Device& device)
{
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
    auto info = describe<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = 4;
    info.poolSizeCount = 1;
    info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool), "create the panel's descriptor pool");
    return {device.handle(), pool};
}

void onResult(VkResult result) { check(result, "draw the panel"); }

void setStyle(float scale)
{
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = style.FrameRounding = 3.0f;
    style.Colors[ImGuiCol_WindowBg].w = 0.88f;
    style.ScaleAllSizes(scale);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // no files where the program happens to run
    ImFontConfig font;
    font.SizePixels = 13.0f * scale;
    io.Fonts->AddFontDefault(&font);
}
} // namespace

Gui::Gui(const engine::Device& device, Window& window, const Swapchain& swapchain)
    : m_device(device), m_pool(createPool(device))
{
    createRenderPass(swapchain.format());
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    setStyle(window.contentScale());
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    ImGui_ImplVulkan_InitInfo info = {};
    info.Instance = device.instance();
    info.PhysicalDevice = device.physical();
    info.Device = device.handle();
    info.QueueFamily = device.queueFamily();
    info.Queue = device.queue();
    info.DescriptorPool = m_pool.get();
    info.MinImageCount = Swapchain::kFramesInFlight;
    info.ImageCount = Swapchain::kFramesInFlight;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = onResult;
    ImGui_ImplVulkan_Init(&info, m_renderPass.get());
    engine::submitAndWait(device, [](VkCommandBuffer cmd) { ImGui_ImplVulkan_CreateFontsTexture(cmd); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Gui::~Gui()
{
    vkDeviceWaitIdle(m_device.handle());
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::createRenderPass(VkFormat format)
{
    VkAttachmentDescription color = {};
    color.format = format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference reference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    auto info = describe<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    check(vkCreateRenderPass(m_device.handle(), &info, nullptr, &pass), "create the panel's render pass");
    m_renderPass = {m_device.handle(), pass};
}

void Gui::followSwapchain(const Swapchain& swapchain)
{
    if (m_generation == swapchain.generation()) return;
    m_generation = swapchain.generation();
    m_framebuffers.clear(); // the swapchain has waited for the device
    for (uint32_t i = 0; i < swapchain.imageCount(); ++i)
    {
        const VkImageView view = swapchain.view(i);
        auto info = describe<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
        info.renderPass = m_renderPass.get();
        info.attachmentCount = 1;
        info.pAttachments = &view;
        info.width = swapchain.extent().width;
        info.height = swapchain.extent().height;
        info.layers = 1;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        check(vkCreateFramebuffer(m_device.handle(), &info, nullptr, &framebuffer), "create a frame buffer");
        m_framebuffers.emplace_back(m_device.handle(), framebuffer);
    }
}

void Gui::beginFrame()
{
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Gui::dropFrame() { ImGui::EndFrame(); }

void Gui::draw(const Swapchain& swapchain, const Swapchain::Frame& frame)
{
    followSwapchain(swapchain);
    ImGui::Render();
    auto info = describe<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = m_renderPass.get();
    info.framebuffer = m_framebuffers[frame.image].get();
    info.renderArea = {{0, 0}, swapchain.extent()};
    vkCmdBeginRenderPass(frame.cmd, &info, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), frame.cmd);
    vkCmdEndRenderPass(frame.cmd);
}

bool Gui::wantsMouse() { return ImGui::GetIO().WantCaptureMouse; }
bool Gui::wantsKeys() { return ImGui::GetIO().WantCaptureKeyboard; }
} // namespace window
