// A baked scene and its viewer in one HTML file.
#pragma once

#include <string>

namespace penumbra::bake {

/// The folder that holds three.js for previews: what PENUMBRA_VIEWER names, else
/// ../share/penumbra/viewer beside the running program. Throws InputError, telling how to get it,
/// if that has no three.js.
std::string viewer_folder();

/// An HTML page that shows the bytes of a .glb file by three.js. All that it needs is inside: it
/// opens from disk, without a network.
std::string preview_html(const std::string& title, const std::string& glb,
                         const std::string& viewer_folder);

}  // namespace penumbra::bake
