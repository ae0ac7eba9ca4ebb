# What looks inside the pipe: scripts over the real tools.
tools_test(AreComparedWithAStudents compare_test)
