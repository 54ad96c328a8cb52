// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_PAGE_TEMPLATE_H
#define FLATTEN_MESH_PAGE_TEMPLATE_H

#include <string_view>
#include <vector>

namespace flattening {

// The page of `write_HTML()` in pieces. Those that are <!--TITLE-->, <!--FIGURES--> or <!--DATA--> stand for what differs from page to page.
// Defined in a source that embed_page.cmake makes of the folder flatten_mesh/page.
const std::vector<std::string_view>& page_template();

} // namespace flattening

#endif // FLATTEN_MESH_PAGE_TEMPLATE_H
