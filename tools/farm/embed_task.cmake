# Puts the script of a farm's tasks into strata_tools, so that the program needs no path to it.
set(farm_folder ${CMAKE_CURRENT_LIST_DIR})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${farm_folder}/task.sh)
file(READ ${farm_folder}/task.sh TASK_SCRIPT)
configure_file(${farm_folder}/task_script.cpp.in ${PROJECT_BINARY_DIR}/generated/task_script.cpp @ONLY)
target_sources(strata_tools PRIVATE ${PROJECT_BINARY_DIR}/generated/task_script.cpp)
