// `--resolution`: pixels along an edge (R) or rays of a picture (WxH).
#pragma once

#include <string>

#include "gridcull/methods/catalog.h"

namespace gridcull {

struct Resolution {
  int edge = 0;               ///< R: 8 .. 8192; 0 where WxH was given, or nothing
  int width = 0, height = 0;  ///< WxH: 1 .. 8192 each
};

/// "256" or "128x72". Throws Error(usage), naming the option.
Resolution parse_resolution(const std::string& text, const std::string& option = "--resolution");

/// "256", "128x72", or "auto" for none.
std::string resolution_text(const Resolution& resolution);

/// Whether the method takes R or WxH, by its options in the catalog.
bool takes_edge(const MethodEntry& method);
bool takes_picture(const MethodEntry& method);

/// Sets the options of a method. Throws Error(usage) when it takes the other form.
void apply_resolution(const Resolution& resolution, const MethodEntry& method, MethodOptions& options);

}  // namespace gridcull
