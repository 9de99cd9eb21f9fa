"""``python3 -m tools.bench_link``."""

from tools.demo.signals import run_command

if __name__ == "__main__":
    run_command("tools.bench_link.command")
