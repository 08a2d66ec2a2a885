// Numbers that kernels and host share: GLSL and, in namespace hmlfc::gpu of device/arguments.hpp, C++.

/// Samples of a block of the reference area that did not decode have this value plus the error's number,
/// which is below any sample.
const int kErrorSample = -32768;

/// Pixels of a group of mark.comp and render.comp, each way.
const uint kGroupLog2 = 3u;
const uint kGroupPixels = 1u << kGroupLog2;

// Words of the counters of a frame.
const uint kCountNeeded = 0u;        // blocks that the frame needs
const uint kCountNeededPages = 1u;   // words of bits with such a block
const uint kCountMissing = 2u;       // needed blocks that are not held
const uint kCountMissingPages = 3u;  // words with such a block of which no block is held
const uint kCountMode = 4u;          // kMode...
const uint kCountDecoded = 5u;       // blocks that the frame decodes, or would with room
const uint kCountPages = 6u;         // pages in use after it, likewise
const uint kCountRequests = 7u;      // requests written so far
const uint kCountNextPage = 8u;      // the next page to be given away
const uint kCountFirstError = 9u;    // the least bit of a block with an error, or kNoError
const uint kCountStatus = 10u;       // that block's error
const uint kCountWorkgroups = 11u;   // of mark.comp that are done
const uint kCountLookedUp = 12u;     // blocks whose disparity the frame looks up
const uint kFrameCounters = 13u;

/// The first error where there is none.
const uint kNoError = 0xFFFFFFFFu;

/// The number of used pages where the next frame must decode all that it needs.
const uint kUsedNothingHeld = 0xFFFFFFFFu;

// Words of the sizes of the dispatches that frame_plan.glsl decides, three each.
const uint kDispatchWalk = 0u;
const uint kDispatchSamples = 3u;
const uint kAllDispatches = 6u;

// What a frame does (frame_plan.glsl).
const uint kModeNoRoom = 0u;  // nothing: the host makes room
const uint kModeAdd = 1u;     // decodes the needed blocks that are not held
const uint kModeFlush = 2u;   // forgets what is held and decodes all needed blocks
