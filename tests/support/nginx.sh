# An nginx for tests, which this user runs. Sourced by shell scripts.

# start_nginx WORK LINES [CERTIFICATE]: serves by the lines of the file LINES, with all its files in WORK; the port is
# in $port, the log of requests in WORK/requests. With a certificate (and its key, in one file) also by HTTPS and HTTP/2,
# at the next port. Status 1 if nginx is not here. End it by stop_nginx.
start_nginx() {
  local nginx secure=
  nginx=$(PATH=$PATH:/usr/sbin command -v nginx) || return 1
  nginx_work=$1
  mkdir -p "$nginx_work"
  port=$((20000 + $$ % 20000))
  while (: < "/dev/tcp/127.0.0.1/$port" || : < "/dev/tcp/127.0.0.1/$((port + 1))") 2> /dev/null; do
    port=$((port + 2))
  done
  [[ ! ${3:-} ]] || secure="listen 127.0.0.1:$((port + 1)) ssl http2; ssl_certificate $3; ssl_certificate_key $3;"
  cat > "$nginx_work/nginx.conf" << END
pid $nginx_work/pid;
user $(id -un) $(id -gn);
worker_rlimit_nofile 8192;
events { worker_connections 4096; }
http {
  access_log $nginx_work/requests;
  client_body_temp_path $nginx_work/t1; proxy_temp_path $nginx_work/t2; fastcgi_temp_path $nginx_work/t3;
  uwsgi_temp_path $nginx_work/t4; scgi_temp_path $nginx_work/t5;
  server { listen 127.0.0.1:$port; $secure include $2; }
}
END
  "$nginx" -p "$nginx_work" -c "$nginx_work/nginx.conf" -e "$nginx_work/errors"
}

stop_nginx() { [[ ! -e ${nginx_work:-}/pid ]] || kill "$(cat "$nginx_work/pid")"; }
