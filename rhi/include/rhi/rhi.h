// All of the abstract interface.
#pragma once
#include <rhi/commands.h>
#include <rhi/device.h>
#include <rhi/error.h>
#include <rhi/format.h>
#include <rhi/pipeline.h>
#include <rhi/resources.h>
#include <rhi/states.h>
