# Checks of the real build tools: nothing is done here.

function(add_rostest)
endfunction()
function(add_rostest_gtest)
endfunction()
function(add_rostest_gmock)
endfunction()
