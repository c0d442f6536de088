"""What one curve shows: its loading branch, slopes, leaps, faces, and evidence of failure.

A tidy curve comes in, a judgement of it goes out. Which of them a standard asks for is not known
here.
"""
