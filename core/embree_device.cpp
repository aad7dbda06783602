#include "gridcull/core/embree_device.h"

#if GRIDCULL_HAS_EMBREE
#include <embree3/rtcore.h>

#include "gridcull/core/error.h"

namespace gridcull {

RTCDeviceTy* embree_device() {
  static const RTCDevice device = [] {
    // Its arena has the size that Embree's devices allow when it is made: one. The second device, which asks for as
    // many threads as TBB has, then lifts the limit from everybody else and must live as long.
    const RTCDevice one = rtcNewDevice("threads=1,set_affinity=0");
    const RTCDevice all = rtcNewDevice("threads=0,set_affinity=0");
    if (one == nullptr || all == nullptr) throw Error(ErrorCode::internal, "Embree: no device");
    return one;
  }();
  // An error that was left behind by a scene that was given up, in this thread.
  rtcGetDeviceError(device);
  return device;
}

}  // namespace gridcull
#endif
