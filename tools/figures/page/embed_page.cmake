# Puts the page of the figures, its style and its script into strata_tools, so that the program needs no path to them.
set(page_folder ${CMAKE_CURRENT_LIST_DIR})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${page_folder}/page.html ${page_folder}/page.css ${page_folder}/page.js)
file(READ ${page_folder}/page.html PAGE_HTML)
file(READ ${page_folder}/page.css PAGE_CSS)
file(READ ${page_folder}/page.js PAGE_JS)
configure_file(${page_folder}/page_texts.cpp.in ${PROJECT_BINARY_DIR}/generated/page_texts.cpp @ONLY)
target_sources(strata_tools PRIVATE ${PROJECT_BINARY_DIR}/generated/page_texts.cpp)
