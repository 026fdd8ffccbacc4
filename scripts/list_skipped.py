#!/usr/bin/python3
"""Lists what a test run left out, and why: list_skipped.py JUNIT_FILE_OF_CTEST"""
import collections
import re
import sys
import xml.etree.ElementTree as tree

# As scripts, GoogleTest, and pytest print the reason.
REASON = re.compile(r"^skipped: (.+)|: Skipped\n(.+)|^SKIPPED \[\d+\] \S+: (.+)", re.MULTILINE)

tests_by_reason = collections.defaultdict(set)
for case in tree.parse(sys.argv[1]).getroot().iter("testcase"):
    reasons = ["".join(match) for match in REASON.findall(case.findtext("system-out") or "")]
    if case.get("status") == "notrun" or case.find("skipped") is not None:
        reasons = reasons or ["no reason given"]
    for reason in reasons:
        tests_by_reason[reason].add(case.get("name"))
for reason, tests in sorted(tests_by_reason.items()):
    some = ", ".join(sorted(tests)[:3]) + (f", and {len(tests) - 3} more" if len(tests) > 3 else "")
    print(f"Skipped: {reason} ({some})")
