// The one Embree device of a process. A device for each scene, asked for one thread, would hold all of TBB in the
// process to one for as long as it lives: Embree sets TBB's limit to the most that any living device asked for.
#pragma once

struct RTCDeviceTy;

namespace gridcull {

/// Made when first asked for, never released; for any number of scenes and threads. Commit a scene with
/// rtcJoinCommitScene: then the calling thread alone builds its tree, so that trees are the same at any number of
/// threads, while TBB keeps the threads it had. (rtcCommitScene would take all of them.)
/// A limit that a program gives Embree by a device of its own has no effect besides.
/// Throws Error(internal) if Embree makes none.
RTCDeviceTy* embree_device();

}  // namespace gridcull
