"""Where things lie in the checkout, for the Python parts."""
import os

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = os.path.join(ROOT, "build")
COLLEKTIVE = os.path.join(ROOT, "collektive")
