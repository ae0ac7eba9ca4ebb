# What looks inside the pipe: scripts over the real tools.
tools_test(AreFlownThrough fly_test)
tools_test(AreInspected inspect_test)
tools_test(AreComparedWithAStudents compare_test)
tools_test(ReportTheirCoverage coverage_report_test)
