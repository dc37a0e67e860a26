#include "pipeline/library/web_page.h"

namespace skylapse::pipeline {

std::string filled_page(std::string_view markup, const PageParts& parts) {
  std::string page(markup);
  for (const auto& [name, text] : parts) {
    const std::string mark = "<!--" + std::string(name) + "-->";
    const size_t at = page.find(mark);
    if (at != std::string::npos) page.replace(at, mark.size(), text);
  }
  return page;
}

std::string style_element(std::string_view css) {
  return "<style>" + std::string(web_text("base.css")) + std::string(css) + "</style>";
}

std::string script_element(std::string_view javascript) {
  return "<script>" + std::string(web_text("dom.js")) + std::string(javascript) + "</script>";
}

std::string data_element(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return R"(<script type="application/json" id="data">)" + safe + "</script>";
}

}  // namespace skylapse::pipeline
