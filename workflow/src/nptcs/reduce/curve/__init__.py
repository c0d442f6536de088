"""What one curve shows: its loading branch, slopes, leaps, faces, and evidence of failure.

A tidy curve comes in; what it shows goes out. What a standard requires of it is not decided here.
"""
