# cmake -DHTML=index.html -DOUT=FOLDER -P embed.cmake: FOLDER/page.js and page.css into the HTML, as FOLDER/page.html, and
# that as FOLDER/page_text.cpp. The text is cut into pieces of a length that every compiler takes.
file(READ ${HTML} page)
file(READ ${OUT}/page.js script)
file(READ ${OUT}/page.css style)
string(REPLACE "/*STYLE*/" "${style}" page "${page}")
string(REPLACE "/*SCRIPT*/" "${script}" page "${page}")
file(WRITE ${OUT}/page.html "${page}")

set(source "// Made by service/page/embed.cmake.\nnamespace gridcull {\nextern const char* const page_pieces[];\nconst char* const page_pieces[] = {\n")
string(LENGTH "${page}" length)
set(at 0)
while(at LESS length)
  string(SUBSTRING "${page}" ${at} 15000 piece)
  string(APPEND source "R\"gridcull_page(${piece})gridcull_page\",\n")
  math(EXPR at "${at} + 15000")
endwhile()
file(WRITE ${OUT}/page_text.cpp "${source}nullptr};\n}  // namespace gridcull\n")
