# Makes a C++ file that holds the page's parts as texts: cmake -DOUT=assets.cpp -DFOLDER=report -P embed.cmake
# Texts are cut into pieces below 16 KB, which every compiler takes; the parts are ASCII, so no character is cut.
set(code "// The parts of the report's page; made from trace/report/ by embed.cmake.\n"
         "#include <motionrack/trace/report_assets.hpp>\n\nnamespace motionrack::trace {\n")
string(CONCAT code ${code})
foreach(pair "page=report.html" "style=report.css" "script_base=base.js" "script_charts=charts.js"
             "script_path=path.js" "script_page=page.js")
  string(REGEX MATCH "^[^=]*" name "${pair}")
  string(REGEX REPLACE "^[^=]*=" "" file "${pair}")
  file(READ "${FOLDER}/${file}" text)
  string(LENGTH "${text}" length)
  string(APPEND code "\nconst char* const report_${name} =")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 12000 piece)
    string(APPEND code "\n    R\"~part~(${piece})~part~\"")
    math(EXPR at "${at} + 12000")
  endwhile()
  string(APPEND code ";\n")
endforeach()
string(APPEND code "\n}  // namespace motionrack::trace\n")
file(WRITE "${OUT}" "${code}")
