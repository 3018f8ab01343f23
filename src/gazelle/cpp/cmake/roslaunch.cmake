# Checks of the real build tools: nothing is done here.

function(roslaunch_add_file_check)
endfunction()
