#pragma once
// Pages that are one file: markup, style, script and data put together, no network needed.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skylapse::pipeline {

/// What stands in the place of marks such as <!--data--> in a page's markup.
using PageParts = std::vector<std::pair<std::string_view, std::string>>;

/// The page with the first mark of each part's name replaced; parts without a mark are left out.
std::string filled_page(std::string_view markup, const PageParts& parts);

/// A style or script element; the shared base.css or dom.js stands before the page's own text.
std::string style_element(std::string_view css);
std::string script_element(std::string_view javascript);

/// JSON inside a script element with the id "data": no "</script>" occurs in it.
std::string data_element(const std::string& json);

/// A file of src/pipeline/library/web by its name, compiled in; empty where there is no such file.
std::string_view web_text(std::string_view name);

}  // namespace skylapse::pipeline
