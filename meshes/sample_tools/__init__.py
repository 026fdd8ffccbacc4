# SPDX-License-Identifier: BSD-3-Clause
"""What make_samples.py draws with. Standard library only; the same files on every run."""
